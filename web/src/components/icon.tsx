/** The page's icons, drawn on a grid of 24 and coloured by the text around them. */

const SHAPES = {
  runs: 'M4 6h16M4 12h16M4 18h10',
  launch: 'M12 5v14M5 12h14',
  minus: 'M5 12h14',
  studies: 'M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z',
  edit: 'M4 20l1-4.5L16.5 4 20 7.5 8.5 19z',
  queue: 'M9 6h11M9 12h11M9 18h11M4.5 4.5v3M3.5 6l1-1.5 1 1.5M4.5 10.5h.01M4.5 13.5h.01M4.5 18h.01',
  workers: 'M5 5h14v6H5zM5 13h14v6H5zM8.5 8h.01M8.5 16h.01',
  settings: 'M4 7h9M17 7h3M13 5v4M4 12h3M11 12h9M7 10v4M4 17h11M19 17h1M15 15v4',
  person: 'M12 4a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM4.5 20c.6-4 3.6-6 7.5-6s6.9 2 7.5 6',
  collapse: 'M11 7l-5 5 5 5M18 7l-5 5 5 5',
  expand: 'M6 7l5 5-5 5M13 7l5 5-5 5',
  sun: 'M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2.5v2M12 19.5v2M2.5 12h2M19.5 12h2M5.3 5.3l1.4 1.4M17.3 17.3l1.4 1.4M18.7 5.3l-1.4 1.4M6.7 17.3l-1.4 1.4',
  moon: 'M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z',
  auto: 'M4 5h16v11H4zM9 20h6M12 16v4',
  blocked: 'M8 4h8M8 20h8M9 4c0 5 6 5 6 8s-6 3-6 8M15 4c0 5-6 5-6 8s6 3 6 8',
  queued: 'M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16zM12 8v4l3 2',
  running: 'M8 5.5v13l10-6.5z',
  paused: 'M9 6v12M15 6v12',
  succeeded: 'M5 12.5l4.5 4.5L19 7.5',
  failed: 'M12 4l9 16H3zM12 10v4M12 17h.01',
  cancelled: 'M12 4a8 8 0 1 0 0 16 8 8 0 0 0 0-16zM6.5 6.5l11 11',
  download: 'M12 4v11M7.5 11l4.5 4.5 4.5-4.5M5 20h14',
  cube: 'M12 3l8 4.5v9L12 21l-8-4.5v-9zM12 12l8-4.5M12 12v9M12 12L4 7.5',
  table: 'M4 5h16v14H4zM4 10h16M4 14.5h16M10 5v14',
  chart: 'M4 4v16h16M7.5 15l4-5 3 3 4.5-6',
  search: 'M11 5a6 6 0 1 0 0 12 6 6 0 0 0 0-12zM15.5 15.5L20 20',
  copy: 'M9 9h11v11H9zM5 15H4V4h11v1',
  close: 'M6 6l12 12M18 6L6 18',
  menu: 'M6 12h.01M12 12h.01M18 12h.01',
  retry: 'M19 12a7 7 0 1 1-2.1-5M19 4v4h-4',
  trash: 'M4.5 7h15M9 7V4.5h6V7M6.5 7l1 12.5h9l1-12.5',
  up: 'M6 14l6-6 6 6',
  down: 'M6 10l6 6 6-6',
  grip: 'M9 6h.01M15 6h.01M9 12h.01M15 12h.01M9 18h.01M15 18h.01',
  release: 'M7 11V8a5 5 0 0 1 9.6-2M5 11h14v9H5z',
  arrow: 'M5 12h14M13 6l6 6-6 6',
  toStart: 'M6 5v14M18 6l-8 6 8 6z',
  toEnd: 'M18 5v14M6 6l8 6-8 6z',
  stepBack: 'M15 6l-7 6 7 6',
  stepOn: 'M9 6l7 6-7 6',
} as const;

export type IconName = keyof typeof SHAPES;

/** One icon; it says nothing to a screen reader, the text beside it does. */
export function Icon({ name, size = 16 }: { name: IconName; size?: number }) {
  return (
    <svg
      aria-hidden="true"
      width={size}
      height={size}
      viewBox="0 0 24 24"
      fill={name === 'running' ? 'currentColor' : 'none'}
      stroke="currentColor"
      strokeWidth={2}
      strokeLinecap="round"
      strokeLinejoin="round"
      style={{ flexShrink: 0, display: 'block' }}
    >
      <path d={SHAPES[name]} />
    </svg>
  );
}
