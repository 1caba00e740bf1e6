/** Light, dark, or as the system says. */
import { Tooltip, useMantineColorScheme } from '@mantine/core';
import { Icon, type IconName } from '@/components/icon';
import classes from './shell.module.css';

const NEXT = { auto: 'light', light: 'dark', dark: 'auto' } as const;
const ICONS: Record<keyof typeof NEXT, IconName> = { auto: 'auto', light: 'sun', dark: 'moon' };
const WORDS = { auto: 'Auto', light: 'Light', dark: 'Dark' };

export function SchemeSwitch() {
  const { colorScheme, setColorScheme } = useMantineColorScheme();
  const next = NEXT[colorScheme];
  return (
    <Tooltip label={`Switch to ${WORDS[next].toLowerCase()}`} position="right">
      <button
        type="button"
        className={classes.place}
        aria-label={`Colour scheme: ${colorScheme}. Switch to ${next}`}
        onClick={() => setColorScheme(next)}
      >
        <Icon name={ICONS[colorScheme]} size={17} />
        <span className={classes.label}>{WORDS[colorScheme]}</span>
      </button>
    </Tooltip>
  );
}
