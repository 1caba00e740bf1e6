/** A secret that is shown this once, to be copied. */
import { CopyButton } from '@/components/copy-button';
import classes from './secret-once.module.css';

export function SecretOnce({ label, secret, note }: { label: string; secret: string; note: string }) {
  return (
    <div className={classes.secret} role="status">
      <b>{label}</b>
      <div className={classes.line}>
        <code className={classes.text}>{secret}</code>
        <CopyButton text={secret} label="Copy" />
      </div>
      <span className="faint">{note}</span>
    </div>
  );
}
