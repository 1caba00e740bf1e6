/** How one hears of what has happened, and how room is made on the disk. */
import { useQuery } from '@tanstack/react-query';
import { SentencePanel } from '@/components/sentence-panel';
import { meQuery } from '@/lib/access';
import { sentence } from '@/lib/api';
import { DesktopNotices } from './components/desktop-notices';
import { RetentionSection } from './components/retention-section';
import classes from './components/settings.module.css';
import { WebhooksSection } from './components/webhooks-section';

export function SettingsPage() {
  const { data, error } = useQuery(meQuery);
  const role = data?.caller?.role;
  return (
    <>
      <title>Settings · SLDR</title>
      <div className="page-head">
        <h1>Settings</h1>
      </div>
      <div className={classes.sections}>
        <DesktopNotices />
        {error && !data && (
          <SentencePanel urgent title="The other settings cannot be shown">
            {sentence(error)}
          </SentencePanel>
        )}
        {role && <WebhooksSection role={role} />}
        {role && <RetentionSection role={role} />}
      </div>
    </>
  );
}
