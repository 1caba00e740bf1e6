/** Everybody's accounts and the audit log, for admins. */
import { useQuery } from '@tanstack/react-query';
import { SentencePanel } from '@/components/sentence-panel';
import { meQuery } from '@/lib/access';
import { sentence } from '@/lib/api';
import { AccountList } from './components/account-list';
import { AuditLog } from './components/audit-log';

export function AccountsPage() {
  const { data: me, error } = useQuery(meQuery);
  return (
    <>
      <title>Accounts · SLDR</title>
      <div className="page-head">
        <h1>Accounts</h1>
      </div>
      {error && !me && (
        <SentencePanel urgent title="The accounts cannot be shown">
          {sentence(error)}
        </SentencePanel>
      )}
      {me?.caller?.role === 'admin' && (
        <>
          <AccountList />
          <AuditLog />
        </>
      )}
      {me?.caller && me.caller.role !== 'admin' && (
        <SentencePanel title="Only admins see this">Ask one of them to change who may do what.</SentencePanel>
      )}
    </>
  );
}
