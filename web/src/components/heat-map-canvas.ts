/** Draw a heat map's cells on a canvas: thousands of them many times a second. */
import { css, type HeatAxis, type HeatCells, inkOn, type Rgb, scaleColour, shareOf } from '@/lib/heat-map';

export interface HeatLook {
  readonly x: HeatAxis;
  readonly y: HeatAxis;
  readonly cells: HeatCells;
  readonly scale: readonly Rgb[];
  readonly range: readonly [number, number];
  readonly format: (value: number | null) => string;
  readonly mark?: readonly [number, number] | undefined;
  readonly isWritten?: boolean | undefined;
}

/** Cells narrower than this are not written on [px]. */
const LEAST_WIDTH = 26;

/** Radius of the mark [px]. */
const MARK = 6;

export function drawHeatMap(canvas: HTMLCanvasElement, width: number, height: number, look: HeatLook): void {
  const pen = canvas.getContext('2d');
  if (pen === null) return;
  const density = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * density);
  canvas.height = Math.round(height * density);
  pen.scale(density, density);
  const [columns, rows] = [look.x.edges.length - 1, look.y.edges.length - 1];
  const [wide, tall] = [width / columns, height / rows];
  pen.font = '11px system-ui, sans-serif';
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  look.cells.forEach((row, up) => {
    row.forEach((value, across) => {
      const [left, top] = [across * wide, height - (up + 1) * tall];
      if (value === null) {
        hatch(pen, left, top, wide, tall);
        return;
      }
      const colour = scaleColour(look.scale, shareOf(value, look.range));
      pen.fillStyle = css(colour);
      // A little larger than the cell, so that no seams are seen between neighbours.
      pen.fillRect(left, top, wide + 0.5, tall + 0.5);
      if (!look.isWritten || wide < LEAST_WIDTH) return;
      pen.fillStyle = inkOn(colour);
      pen.fillText(look.format(value), left + wide / 2, top + tall / 2);
    });
  });
  if (look.mark !== undefined)
    drawMark(pen, placeOf(look.x, look.mark[0]) * width, height - placeOf(look.y, look.mark[1]) * height);
}

/** Where a value lies along an axis, 0 to 1. */
function placeOf(axis: HeatAxis, value: number): number {
  return shareOf(value, [axis.edges[0] ?? 0, axis.edges.at(-1) ?? 1]);
}

/** A cell about which nothing is known. */
function hatch(pen: CanvasRenderingContext2D, left: number, top: number, wide: number, tall: number): void {
  pen.strokeStyle = 'rgb(128 128 128 / 35%)';
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(left, top + tall);
  pen.lineTo(left + wide, top);
  pen.stroke();
}

/** A ring that is seen on every colour. */
function drawMark(pen: CanvasRenderingContext2D, x: number, y: number): void {
  for (const [colour, thickness] of [
    ['#000', 4],
    ['#fff', 2],
  ] as const) {
    pen.strokeStyle = colour;
    pen.lineWidth = thickness;
    pen.beginPath();
    pen.arc(x, y, MARK, 0, 2 * Math.PI);
    pen.stroke();
  }
}
