/** The same launch as a command and as a script, to read and to copy. */
import { CopyButton } from '@/components/copy-button';
import classes from './ways-in.module.css';

interface Props {
  command: string;
  script: string;
}

export function WaysIn({ command, script }: Props) {
  return (
    <details className={classes.ways}>
      <summary>As a command or script</summary>
      <Text label="Copy as CLI" text={command} />
      <Text label="Copy as Python" text={script} />
    </details>
  );
}

function Text({ label, text }: { label: string; text: string }) {
  return (
    <section aria-label={label.replace('Copy as', 'As')}>
      <CopyButton text={text} label={label} />
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: long lines are scrolled by keyboard. */}
      <pre className={classes.text} tabIndex={0}>
        {text}
      </pre>
    </section>
  );
}
