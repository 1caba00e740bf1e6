/** The look of every Mantine part: dense, calm, one accent. */
import { type CSSVariablesResolver, createTheme, type MantineColorsTuple } from '@mantine/core';
import { type Scheme, STATE_COLORS } from '@/lib/palette';
import { RUN_STATES } from '@/lib/states';

const ACCENT: MantineColorsTuple = [
  '#e9f3fb',
  '#d3e5f4',
  '#a7cae8',
  '#78aedc',
  '#5296d1',
  '#3a87ca',
  '#2474bb',
  '#1c6cb1',
  '#0f609f',
  '#00538d',
];

/** Mantine's greys of the dark scheme, with the cool tint of the page's own surfaces. */
const DARK: MantineColorsTuple = [
  '#d5d9df',
  '#b9bfc8',
  '#949ca8',
  '#6b7380',
  '#3a414b',
  '#333941',
  '#23272e',
  '#1a1d22',
  '#15181c',
  '#101215',
];

const SYSTEM_FONT =
  'ui-sans-serif, system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif';

export const theme = createTheme({
  primaryColor: 'accent',
  primaryShade: { light: 7, dark: 6 },
  colors: { accent: ACCENT, dark: DARK },
  fontFamily: SYSTEM_FONT,
  fontFamilyMonospace: 'ui-monospace, SFMono-Regular, Menlo, Consolas, "Liberation Mono", monospace',
  headings: { fontFamily: SYSTEM_FONT, fontWeight: '650' },
  defaultRadius: 'sm',
  respectReducedMotion: true,
  cursorType: 'pointer',
  components: {
    InputWrapper: {
      styles: {
        description: { fontSize: 12, lineHeight: 1.4, color: 'var(--faint)' },
        error: { fontSize: 12, color: 'var(--state-failed)' },
      },
    },
    Button: { defaultProps: { size: 'sm' } },
    TextInput: { defaultProps: { size: 'sm' } },
    Select: { defaultProps: { size: 'sm', allowDeselect: false } },
    // What is opened stays until it is closed, also when the page scrolls under it.
    Menu: { defaultProps: { hideDetached: false } },
    Popover: { defaultProps: { hideDetached: false } },
    Tooltip: { defaultProps: { withArrow: true, fz: 12 } },
  },
});

/** Colours that Mantine does not know: the page's ground and the run states. */
export const cssVariables: CSSVariablesResolver = () => ({
  variables: {},
  light: {
    '--mantine-color-body': 'var(--ground)',
    '--mantine-color-placeholder': '#767d88',
    ...stateVariables('light'),
  },
  dark: {
    '--mantine-color-body': 'var(--ground)',
    '--mantine-color-placeholder': '#858d99',
    ...stateVariables('dark'),
  },
});

function stateVariables(scheme: Scheme): Record<string, string> {
  return Object.fromEntries(RUN_STATES.map((state) => [`--state-${state}`, STATE_COLORS[state][scheme]]));
}
