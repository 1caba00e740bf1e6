/** The choices of the launch form, as they stand in the address. */

export interface LaunchSearch {
  readonly task?: string;
  readonly phase?: 'locomotion' | 'manipulation';
  readonly method?: string;
  readonly preset?: string;
  readonly seeds?: string;
  /** `zoo`, `train`, or ids of locomotion runs. */
  readonly locomotion?: string;
  /** The id of the run that is launched again. */
  readonly from?: string;
}

/** Read the choices from an address; what makes no sense is left out. */
export function readLaunchSearch(raw: Record<string, unknown>): LaunchSearch {
  const text = (key: string): string | undefined => {
    const value = raw[key];
    return value === undefined || value === null || value === '' ? undefined : String(value);
  };
  const phase = text('phase');
  return {
    task: text('task'),
    phase: phase === 'locomotion' || phase === 'manipulation' ? phase : undefined,
    method: text('method'),
    preset: text('preset'),
    locomotion: text('locomotion'),
    from: text('from'),
    // An empty field stays empty: the form says that a seed is missing.
    seeds: raw.seeds === undefined ? undefined : String(raw.seeds ?? ''),
  };
}
