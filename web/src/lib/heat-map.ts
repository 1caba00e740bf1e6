/** What a heat map is made of: cells with values, colours between those of a scale, and the ink that is read on them. */

export type Rgb = readonly [number, number, number];

/** One direction of a heat map. */
export interface HeatAxis {
  readonly name: string;
  readonly unit: string;
  /** From the lower edge of the first cell to the upper edge of the last. */
  readonly edges: readonly number[];
  /** What the cells are called, where numbers would say nothing. */
  readonly names: readonly string[];
}

/** Values of cells, row by row from below; null where there is none. */
export type HeatCells = readonly (readonly (number | null)[])[];

/** Above this brightness dark ink is read better than white, of 255. */
const BRIGHT = 140;

/** The colour of a share from 0 to 1, between the colours of a scale. */
export function scaleColour(scale: readonly Rgb[], share: number): Rgb {
  const place = Math.min(1, Math.max(0, share)) * (scale.length - 1);
  const below = Math.min(Math.floor(place), scale.length - 2);
  const [low, high] = [scale[below] ?? [0, 0, 0], scale[below + 1] ?? [0, 0, 0]];
  const mix = (channel: 0 | 1 | 2): number =>
    Math.round(low[channel] + (place - below) * (high[channel] - low[channel]));
  return [mix(0), mix(1), mix(2)];
}

/** A colour as CSS has it. */
export function css([red, green, blue]: Rgb): string {
  return `rgb(${red} ${green} ${blue})`;
}

/** The ink that is read on a colour. */
export function inkOn([red, green, blue]: Rgb): string {
  return 0.299 * red + 0.587 * green + 0.114 * blue > BRIGHT ? '#111' : '#fff';
}

/** The least and the greatest value; undefined without any. */
export function rangeOf(cells: HeatCells): readonly [number, number] | undefined {
  const values = cells.flat().filter((value) => value !== null);
  return values.length === 0 ? undefined : [Math.min(...values), Math.max(...values)];
}

/** Where a value lies in a range, 0 to 1; 0 in a range without width. */
export function shareOf(value: number, [low, high]: readonly [number, number]): number {
  return high > low ? (value - low) / (high - low) : 0;
}

/** What a cell of an axis is called: its name, or the numbers it lies between. */
export function cellName(axis: HeatAxis, cell: number): string {
  const [low, high] = [axis.edges[cell], axis.edges[cell + 1]];
  return axis.names[cell] ?? `${round(low)} to ${round(high)}${axis.unit && `\u202f${axis.unit}`}`;
}

/** A number as short as an axis needs it. */
export function round(value: number | undefined): string {
  return value === undefined ? '' : String(Number(value.toPrecision(3)));
}

/** The axis of points that lie evenly: each in the middle of its cell. */
export function axisOfPoints(name: string, unit: string, points: readonly number[]): HeatAxis {
  const [first = 0, second = 1] = points;
  const half = (second - first) / 2;
  return { name, unit, edges: [...points.map((point) => point - half), (points.at(-1) ?? 0) + half], names: [] };
}
