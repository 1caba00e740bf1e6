/** Cells in colours, with the same numbers as a table for those who cannot tell the colours. */
import { useElementSize } from '@mantine/hooks';
import { type PointerEvent, useEffect, useRef, useState } from 'react';
import { cellName, css, type HeatAxis, type HeatCells, type Rgb, rangeOf, round, scaleColour } from '@/lib/heat-map';
import classes from './heat-map.module.css';
import { drawHeatMap } from './heat-map-canvas';
import { HeatTable } from './heat-table';

export interface HeatMapProps {
  /** What it shows, in a sentence. */
  description: string;
  x: HeatAxis;
  y: HeatAxis;
  cells: HeatCells;
  scale: readonly Rgb[];
  /** What the colours reach from and to; that of the values if it is not given. */
  range?: readonly [number, number] | undefined;
  format: (value: number | null) => string;
  /** More about a cell, for those who point at it. */
  tell?: (column: number, row: number) => string;
  /** What is the case now. */
  mark?: readonly [number, number] | undefined;
  /** Whether cells are written on, too, where there is room. */
  isWritten?: boolean;
  /** The table shows every so-manieth row and column. */
  tableEvery?: number;
}

export function HeatMap(props: HeatMapProps) {
  const { description, x, y, cells, scale, format, tell } = props;
  const { ref: frame, width, height } = useElementSize();
  const canvas = useRef<HTMLCanvasElement>(null);
  const [at, setAt] = useState<readonly [number, number] | null>(null);
  const range = props.range ?? rangeOf(cells) ?? [0, 1];
  useEffect(() => {
    if (canvas.current !== null && width > 0) drawHeatMap(canvas.current, width, height, { ...props, range });
  });
  const point = (event: PointerEvent): void => {
    const box = event.currentTarget.getBoundingClientRect();
    const column = Math.floor(((event.clientX - box.left) / box.width) * (x.edges.length - 1));
    const row = Math.floor(((box.bottom - event.clientY) / box.height) * (y.edges.length - 1));
    setAt(cells[row]?.[column] === undefined ? null : [column, row]);
  };
  return (
    <figure className={classes.map}>
      <div className={classes.plot}>
        <YLabels axis={y} />
        <div ref={frame} className={classes.canvas} onPointerMove={point} onPointerLeave={() => setAt(null)}>
          <canvas ref={canvas} role="img" aria-label={description} />
        </div>
        <XLabels axis={x} />
      </div>
      <div className={classes.legend}>
        <span className="number">{format(range[0])}</span>
        <span className={classes.bar} style={{ background: gradient(scale) }} aria-hidden="true" />
        <span className="number">{format(range[1])}</span>
        <span className={`faint ${classes.told}`}>
          {at &&
            `${cellName(x, at[0])}, ${cellName(y, at[1])}: ${tell?.(...at) ?? format(cells[at[1]]?.[at[0]] ?? null)}`}
        </span>
      </div>
      <HeatTable {...props} />
    </figure>
  );
}

function XLabels({ axis }: { axis: HeatAxis }) {
  return (
    <div className={classes.across}>
      <span>{round(axis.edges[0])}</span>
      <span>{label(axis)}</span>
      <span>{round(axis.edges.at(-1))}</span>
    </div>
  );
}

function YLabels({ axis }: { axis: HeatAxis }) {
  if (axis.names.length > 0) {
    return (
      <div className={classes.named}>
        {axis.names.toReversed().map((name) => (
          <span key={name}>{name}</span>
        ))}
      </div>
    );
  }
  return (
    <div className={classes.up}>
      <span>{round(axis.edges.at(-1))}</span>
      <span className={classes.upName}>{label(axis)}</span>
      <span>{round(axis.edges[0])}</span>
    </div>
  );
}

function label({ name, unit }: HeatAxis): string {
  return unit === '' ? name : `${name} [${unit}]`;
}

function gradient(scale: readonly Rgb[]): string {
  return `linear-gradient(to right, ${scale.map((_, at) => css(scaleColour(scale, at / (scale.length - 1)))).join(', ')})`;
}
