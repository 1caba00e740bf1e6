/** What surrounds every page: the rail, the banner when the server is away, the page itself. */
import { useLocalStorage } from '@mantine/hooks';
import { Outlet } from '@tanstack/react-router';
import { useState } from 'react';
import { ConnectionBanner } from '@/app/connection-banner';
import { type Guide, KeyboardGuide } from '@/app/keyboard-guide';
import { Notices } from '@/app/notices';
import { Rail } from '@/app/rail';
import { RoleNote } from '@/app/role-note';
import classes from './shell.module.css';

export function Shell() {
  const [isNarrow, setNarrow] = useLocalStorage({
    key: 'sldr-rail-narrow',
    defaultValue: false,
    getInitialValueInEffect: false,
  });
  const [guide, showGuide] = useState<Guide | null>(null);
  return (
    <div className={classes.shell} data-narrow={isNarrow || undefined}>
      <a className={classes.skip} href="#main">
        Skip to the page
      </a>
      <Rail isNarrow={isNarrow} onToggle={() => setNarrow(!isNarrow)} onFind={() => showGuide('palette')} />
      <KeyboardGuide shown={guide} onShow={showGuide} />
      <div className={classes.content}>
        <ConnectionBanner />
        <Notices />
        <RoleNote />
        <main id="main" tabIndex={-1} className={classes.main}>
          <Outlet />
        </main>
      </div>
    </div>
  );
}
