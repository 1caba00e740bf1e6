/** The list of every shortcut. */
import { Kbd, Modal } from '@mantine/core';
import { SHORTCUTS, type Shortcut } from '@/lib/shortcuts';
import classes from './shortcuts.module.css';

export function ShortcutsDialog({ onClose }: { onClose: () => void }) {
  return (
    <Modal opened onClose={onClose} title="Keyboard shortcuts" size="lg" closeButtonProps={{ 'aria-label': 'Close' }}>
      <p className={classes.note}>None of them works while you type in a field, except Ctrl K.</p>
      {SHORTCUTS.map(({ title, shortcuts }) => (
        <section key={title} className={classes.group} aria-label={title}>
          <h3>{title}</h3>
          <dl>
            {shortcuts.map((shortcut) => (
              <div key={shortcut.does} className={classes.line}>
                <dt>{shortcut.does}</dt>
                <dd>
                  <Ways {...shortcut} />
                </dd>
              </div>
            ))}
          </dl>
        </section>
      ))}
    </Modal>
  );
}

/** `g r` is two keys one after the other, `Page Up` is one, and `Shift+↑` two at once. */
function Ways({ keys }: Pick<Shortcut, 'keys'>) {
  return keys.map((way, at) => (
    <span key={way} className={classes.way}>
      {at > 0 && <span className="faint">or</span>}
      {way.split(/(?<=^g) |(?<=.)\+/).map((key) => (
        <Kbd key={key} size="xs">
          {key}
        </Kbd>
      ))}
    </span>
  ));
}
