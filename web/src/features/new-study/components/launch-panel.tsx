/** What this study would queue, reuse and cost; its name; and the button that launches it. */
import { Button, TextInput } from '@mantine/core';
import { PreviewSums } from '@/components/preview-sums';
import { WaysIn } from '@/components/ways-in';
import { NOT_YOURS, useMay } from '@/lib/access';
import { Refused, sentence } from '@/lib/api';
import { formatPlural } from '@/lib/format';
import { studyCommand, studyScript } from '@/lib/ways-in';
import type { StudyDraft } from '../use-draft';
import classes from './builder.module.css';

interface Props {
  form: StudyDraft;
  /** Why the launch was refused. */
  refusal: Error | null;
  isLaunching: boolean;
  onName: (name: string) => void;
}

export function LaunchPanel({ form, refusal, isLaunching, onName }: Props) {
  const { preview, isPreviewing, problems } = form;
  const isMine = useMay('operator');
  const marked = [problems.tasks, problems.methods, problems.seeds, ...Object.values(problems.rows)].filter(Boolean);
  const refused = [form.refusal, refusal].flatMap(sentencesOf);
  return (
    <aside className={`card ${classes.panel}`} aria-label="What will be queued">
      <TextInput
        label="Name"
        maxLength={80}
        placeholder={form.name}
        value={form.draft.name}
        onChange={(event) => onName(event.currentTarget.value)}
      />
      <div aria-live="polite" className={classes.panelBody} data-previewing={isPreviewing || undefined}>
        {preview ? <PreviewSums preview={preview} /> : refused.length === 0 && <Waiting marked={marked.length} />}
        {refused.map((text) => (
          <p key={text} className="problem" role="alert">
            {text}
          </p>
        ))}
      </div>
      <Button
        type="submit"
        fullWidth
        size="md"
        loading={isLaunching}
        disabled={!isMine || form.spec === null || preview === undefined || isPreviewing}
      >
        {preview === undefined
          ? 'Launch the study'
          : preview.queued === 0
            ? 'Gather what exists'
            : `Launch ${formatPlural(preview.queued, 'run')}`}
      </Button>
      {!isMine && <p className="faint">{NOT_YOURS}</p>}
      {form.spec && (
        <WaysIn
          command={studyCommand(form.name, form.spec, window.location.origin)}
          script={studyScript(form.name, form.spec, window.location.origin)}
        />
      )}
    </aside>
  );
}

function Waiting({ marked }: { marked: number }) {
  return <p className="faint">{marked > 0 ? 'Mend the marked fields first.' : 'Looking…'}</p>;
}

function sentencesOf(error: Error | null): string[] {
  if (error === null) return [];
  if (!(error instanceof Refused)) return [sentence(error)];
  return error.problems.map(({ field, message }) => (field ? `${field}: ${message}` : message));
}
