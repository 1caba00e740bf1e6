/** The way to every page. */
import { Tooltip } from '@mantine/core';
import { Link } from '@tanstack/react-router';
import { SchemeSwitch } from '@/app/scheme-switch';
import { Icon, type IconName } from '@/components/icon';
import classes from './shell.module.css';

type Place = '/' | '/launch' | '/studies' | '/compare' | '/queue' | '/workers' | '/settings';

const PLACES: readonly { to: Place; label: string; icon: IconName }[] = [
  { to: '/', label: 'Runs', icon: 'runs' },
  { to: '/launch', label: 'New run', icon: 'launch' },
  { to: '/studies', label: 'Studies', icon: 'studies' },
  { to: '/compare', label: 'Compare', icon: 'chart' },
  { to: '/queue', label: 'Queue', icon: 'queue' },
  { to: '/workers', label: 'Workers', icon: 'workers' },
  { to: '/settings', label: 'Settings', icon: 'settings' },
];

export function Rail({ isNarrow, onToggle }: { isNarrow: boolean; onToggle: () => void }) {
  return (
    <nav className={classes.rail} aria-label="Main">
      <Link to="/" className={classes.brand} aria-label="SLDR, all runs">
        <img src="/icon.svg" alt="" width={24} height={24} />
        <span className={classes.label}>SLDR</span>
      </Link>
      <div className={classes.places}>
        {PLACES.map(({ to, label, icon }) => (
          <Tooltip key={to} label={label} position="right" disabled={!isNarrow}>
            <Link
              to={to}
              className={classes.place}
              activeOptions={{ exact: to !== '/studies', includeSearch: false }}
              activeProps={{ 'aria-current': 'page' }}
              aria-label={label}
            >
              <Icon name={icon} size={17} />
              <span className={classes.label}>{label}</span>
            </Link>
          </Tooltip>
        ))}
      </div>
      <div className={classes.foot}>
        <Tooltip label="Account" position="right" disabled={!isNarrow}>
          <Link to="/account" className={classes.place} activeProps={{ 'aria-current': 'page' }} aria-label="Account">
            <Icon name="person" size={17} />
            <span className={classes.label}>Account</span>
          </Link>
        </Tooltip>
        <SchemeSwitch />
        <button
          type="button"
          className={`${classes.place} ${classes.toggle}`}
          onClick={onToggle}
          aria-expanded={!isNarrow}
          aria-label={isNarrow ? 'Widen the rail' : 'Narrow the rail'}
        >
          <Icon name={isNarrow ? 'expand' : 'collapse'} size={17} />
          <span className={classes.label}>Narrow</span>
        </button>
      </div>
    </nav>
  );
}
