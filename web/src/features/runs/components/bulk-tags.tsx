/** Give the selected runs tags, or take some away. */
import { Button, Popover } from '@mantine/core';
import { useState } from 'react';
import type { RunSummary } from '@/client/schema.gen';
import { TagField } from '@/components/tag-field';
import { useComplaint, useToast } from '@/components/toasts';
import { formatPlural } from '@/lib/format';
import { useChangeTags } from '@/lib/labels';
import classes from './runs.module.css';

export function BulkTags({ runs }: { runs: readonly RunSummary[] }) {
  const [isOpen, setOpen] = useState(false);
  return (
    <Popover opened={isOpen} onChange={setOpen} position="top" withArrow trapFocus returnFocus>
      <Popover.Target>
        <Button variant="default" size="compact-sm" onClick={() => setOpen(!isOpen)}>
          Tags
        </Button>
      </Popover.Target>
      <Popover.Dropdown>{isOpen && <TagForm runs={runs} onDone={() => setOpen(false)} />}</Popover.Dropdown>
    </Popover>
  );
}

function TagForm({ runs, onDone }: { runs: readonly RunSummary[]; onDone: () => void }) {
  const [add, setAdd] = useState<string[]>([]);
  const [remove, setRemove] = useState<string[]>([]);
  const toast = useToast();
  const complain = useComplaint();
  const changing = useChangeTags();
  const there = [...new Set(runs.flatMap((run) => run.tags))].sort();
  const apply = (): void => {
    const changed = changing.mutateAsync({ runIds: runs.map((run) => run.id), add, remove }, { onSuccess: onDone });
    // It is told wherever one is by then.
    changed.then(() => toast({ text: `The tags of ${formatPlural(runs.length, 'run')} are changed.` }), complain);
  };
  return (
    <div className={classes.choices}>
      <TagField label="Add tags" value={add} onChange={setAdd} placeholder="Type, then Enter" />
      {there.length > 0 && <TagField label="Take away" value={remove} onChange={setRemove} known={there} />}
      <Button size="xs" loading={changing.isPending} disabled={add.length === 0 && remove.length === 0} onClick={apply}>
        Change the tags of {formatPlural(runs.length, 'run')}
      </Button>
    </div>
  );
}
