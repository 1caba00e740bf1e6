/** Make room: choose what ended runs may lose, see what that frees, remove it. */
import { Button, Checkbox, Modal, NumberInput } from '@mantine/core';
import { useDebouncedValue, useDisclosure } from '@mantine/hooks';
import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import type { Removable } from '@/client/schema.gen';
import { CardSection } from '@/components/card-section';
import { useComplaint, useToast } from '@/components/toasts';
import { allows, type Role } from '@/lib/access';
import { sentence } from '@/lib/api';
import { formatPlural, formatSize } from '@/lib/format';
import { retentionQuery, useApplyRetention } from '../api/retention';
import { KINDS } from '../kinds';
import { RetentionPreviewTable } from './retention-preview';
import classes from './settings.module.css';

/** Rest after the last change before the preview is asked for [ms]. */
const REST_MS = 250;
/** Days that a rule may spare runs for. */
const LONGEST_DAYS = 3650;

export function RetentionSection({ role }: { role: Role }) {
  const [kinds, setKinds] = useState<Removable[]>(['replay']);
  const [days, setDays] = useState<number>(30);
  // A new object each time would never come to rest.
  const wanted = useMemo(() => ({ kinds, older_than_days: days }), [kinds, days]);
  const [rule] = useDebouncedValue(wanted, REST_MS);
  const { data: preview, error, isPlaceholderData } = useQuery(retentionQuery(rule));
  const applying = useApplyRetention();
  const toast = useToast();
  const complain = useComplaint();
  const [isAsking, asking] = useDisclosure(false);
  const isFresh = rule === wanted && !isPlaceholderData;
  const remove = (): void => {
    const removed = applying.mutateAsync(rule, { onSettled: asking.close });
    // It is told wherever one is by then.
    removed.then(
      ({ files, runs, size }) =>
        toast({ text: `Removed ${formatPlural(files, 'file')} of ${formatPlural(runs, 'run')}: ${formatSize(size)}.` }),
      complain,
    );
  };
  return (
    <CardSection title="Make room" note={<StayingNote />}>
      <fieldset className={classes.kinds}>
        <legend className="hidden">What may go</legend>
        {KINDS.map(({ kind, label, summary }) => (
          <Checkbox
            key={kind}
            label={label}
            description={summary}
            checked={kinds.includes(kind)}
            onChange={({ currentTarget: { checked } }) =>
              setKinds((others) => (checked ? [...others, kind] : others.filter((other) => other !== kind)))
            }
          />
        ))}
      </fieldset>
      <NumberInput
        label="Only of runs that ended at least so many days ago"
        classNames={{ wrapper: classes.days }}
        min={0}
        max={LONGEST_DAYS}
        allowDecimal={false}
        value={days}
        onChange={(value) => setDays(Number(value) || 0)}
      />
      {error && <p className="problem">{sentence(error)}</p>}
      {kinds.length > 0 && preview && <RetentionPreviewTable preview={preview} days={rule.older_than_days} />}
      {allows(role, 'admin') ? (
        <div>
          <Button color="red" disabled={!preview?.total_runs || kinds.length === 0 || !isFresh} onClick={asking.open}>
            Remove …
          </Button>
        </div>
      ) : (
        <p className="faint">Only an admin may remove them.</p>
      )}
      <Modal opened={isAsking} onClose={asking.close} title="Remove these files?">
        <p>
          {preview &&
            `${formatSize(preview.size)} of ${formatPlural(preview.total_runs, 'run')} will be gone for good.`}
        </p>
        <div className={classes.row}>
          <Button color="red" loading={applying.isPending} onClick={remove}>
            Remove them
          </Button>
          <Button variant="default" onClick={asking.close}>
            Keep them
          </Button>
        </div>
      </Modal>
    </CardSection>
  );
}

function StayingNote() {
  return (
    <>
      Results stay: metrics, logs, newest and best policies, locomotion models. Runs tagged <code>keep</code> or{' '}
      <code>starred</code> and runs that others learn from lose nothing.
    </>
  );
}
