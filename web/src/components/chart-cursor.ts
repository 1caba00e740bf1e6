/** What the mouse does in every chart: one cursor for all of a page, a drag zooms, a double click shows all. */
import type uPlot from 'uplot';
import { CHART_INK, type Scheme } from '@/lib/palette';
import type { Range } from '@/lib/zoom';

/** A drag shorter than this is a click [px]. */
const LEAST_DRAG = 5;

/** Where uPlot draws no cursor [px]. */
const NOWHERE = { left: -10, top: -10 };

type OnZoom = (range: Range | null) => void;

/** A cursor that all charts of one name share. */
export function sharedCursor(name: string, onZoom: OnZoom): uPlot.Cursor {
  return {
    y: false,
    drag: { x: true, y: false, setScale: false, dist: LEAST_DRAG },
    sync: {
      key: name,
      scales: ['x', null],
      filters: { pub: (type) => type === 'mousemove' || type === 'mouseleave', sub: () => true },
    },
    bind: {
      dblclick: () => () => {
        onZoom(null);
        return null;
      },
    },
  };
}

/** Show the part chosen by a drag. */
export function zoomToSelection(plot: uPlot, onZoom: OnZoom): void {
  const { left, width } = plot.select;
  if (width < LEAST_DRAG) return;
  onZoom([plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x')]);
  plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
}

/** Put the cursor at a place of the x axis, or nowhere, in this chart and in those that share it. */
export function pointAt(plot: uPlot | null, place: number | null): void {
  if (plot === null) return;
  const setCursor = plot.setCursor as (at: { left: number; top: number }, fire: boolean, share: boolean) => void;
  const top = plot.over.clientHeight / 2;
  setCursor(place === null ? NOWHERE : { left: plot.valToPos(place, 'x'), top }, true, true);
}

/** How the axes of a chart are drawn. */
export function axisLook(scheme: Scheme): uPlot.Axis {
  const { text, grid } = CHART_INK[scheme];
  const font = '11px system-ui, sans-serif';
  return { stroke: text, font, grid: { stroke: grid, width: 1 }, ticks: { show: false } };
}
