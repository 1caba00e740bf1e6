/** The way to every page. */
import { Tooltip } from '@mantine/core';
import { Link } from '@tanstack/react-router';
import { SchemeSwitch } from '@/app/scheme-switch';
import { Icon, type IconName } from '@/components/icon';
import { useMay } from '@/lib/access';
import { PLACES, type PlacePath } from '@/lib/places';
import classes from './shell.module.css';

const ICONS: Readonly<Record<PlacePath, IconName>> = {
  '/': 'runs',
  '/launch': 'launch',
  '/studies': 'studies',
  '/compare': 'chart',
  '/queue': 'queue',
  '/workers': 'workers',
  '/settings': 'settings',
  '/account': 'person',
};

interface Props {
  isNarrow: boolean;
  onToggle: () => void;
  onFind: () => void;
}

export function Rail({ isNarrow, onToggle, onFind }: Props) {
  const mayLaunch = useMay('operator');
  return (
    <nav className={classes.rail} aria-label="Main">
      <Link to="/" className={classes.brand} aria-label="SLDR, all runs">
        <img src="/icon.svg" alt="" width={24} height={24} />
        <span className={classes.label}>SLDR</span>
      </Link>
      <div className={classes.places}>
        {PLACES.filter(({ to }) => mayLaunch || to !== '/launch').map(({ to, label }) => (
          <Tooltip key={to} label={label} position="right" disabled={!isNarrow}>
            <Link
              to={to}
              className={classes.place}
              activeOptions={{ exact: to !== '/studies', includeSearch: false }}
              activeProps={{ 'aria-current': 'page' }}
              aria-label={label}
            >
              <Icon name={ICONS[to]} size={17} />
              <span className={classes.label}>{label}</span>
            </Link>
          </Tooltip>
        ))}
      </div>
      <div className={classes.foot}>
        <Tooltip label="Find anything (Ctrl K)" position="right" openDelay={isNarrow ? 0 : 400}>
          <button
            type="button"
            className={classes.place}
            onClick={onFind}
            aria-label="Find anything"
            aria-keyshortcuts="Control+K Meta+K"
          >
            <Icon name="search" size={17} />
            <span className={classes.label}>Find</span>
          </button>
        </Tooltip>
        <Tooltip label="Account" position="right" disabled={!isNarrow}>
          <Link to="/account" className={classes.place} activeProps={{ 'aria-current': 'page' }} aria-label="Account">
            <Icon name={ICONS['/account']} size={17} />
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
