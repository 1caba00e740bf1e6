/** What holds for all charts: the x axis, the smoothing, the zoom. */
import { Button, SegmentedControl, Slider } from '@mantine/core';
import { AXIS_NAMES } from '../charts';
import { AXES, type Axis, MOST_SMOOTHING } from '../search';
import classes from './charts.module.css';

interface Props {
  axis: Axis;
  weight: number;
  isZoomed: boolean;
  onAxis: (axis: Axis) => void;
  onWeight: (weight: number) => void;
  onReset: () => void;
}

export function ChartControls({ axis, weight, isZoomed, onAxis, onWeight, onReset }: Props) {
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
      {isZoomed ? (
        <Button variant="light" size="compact-xs" onClick={onReset}>
          Show all and follow
        </Button>
      ) : (
        <span className={`faint ${classes.hint}`}>Drag in a chart to zoom, double-click to reset.</span>
      )}
    </div>
  );
}
