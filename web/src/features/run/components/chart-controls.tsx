/** What holds for all charts: the x axis, the smoothing, the zoom. */
import { ActionIcon, Button, SegmentedControl, Slider } from '@mantine/core';
import { Icon } from '@/components/icon';
import { AXIS_NAMES } from '../charts';
import { AXES, type Axis, MOST_SMOOTHING } from '../search';
import classes from './charts.module.css';

interface Props {
  axis: Axis;
  weight: number;
  isZoomed: boolean;
  onAxis: (axis: Axis) => void;
  onWeight: (weight: number) => void;
  /** Called with what the shown width is to be multiplied by. */
  onZoom: (factor: number) => void;
  onReset: () => void;
}

/** How much a click on a button zooms. */
const ZOOM = 0.5;

export function ChartControls({ axis, weight, isZoomed, onAxis, onWeight, onZoom, onReset }: Props) {
  return (
    <div className={classes.controls}>
      <SegmentedControl
        size="xs"
        aria-label="X axis"
        value={axis}
        onChange={(value) => onAxis(value as Axis)}
        data={AXES.map((value) => ({ value, label: AXIS_NAMES[value] }))}
      />
      <div className={classes.smoothing}>
        <span id="smoothing-name">Smoothing</span>
        <Slider
          size="sm"
          w={120}
          min={0}
          max={MOST_SMOOTHING}
          step={0.01}
          value={weight}
          onChange={(value) => onWeight(Number(value.toFixed(2)))}
          label={null}
          thumbLabel="Smoothing"
        />
        <span className="number faint">{weight.toFixed(2)}</span>
      </div>
      <div className={classes.zoom}>
        <ActionIcon variant="default" size="sm" aria-label="Zoom in" onClick={() => onZoom(ZOOM)}>
          <Icon name="launch" size={13} />
        </ActionIcon>
        <ActionIcon
          variant="default"
          size="sm"
          aria-label="Zoom out"
          disabled={!isZoomed}
          onClick={() => onZoom(1 / ZOOM)}
        >
          <Icon name="minus" size={13} />
        </ActionIcon>
        {isZoomed ? (
          <Button variant="light" size="compact-xs" onClick={onReset}>
            Show all and follow
          </Button>
        ) : (
          <span className={`faint ${classes.hint}`}>
            Drag in a chart, or press + and − in it, to zoom; a double click or 0 shows all.
          </span>
        )}
      </div>
    </div>
  );
}
