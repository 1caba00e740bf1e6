/** What holds for all charts: the x axis, the smoothing, the zoom. */
import { ActionIcon, Button, SegmentedControl } from '@mantine/core';
import { Icon } from '@/components/icon';
import { SmoothingSlider } from '@/components/smoothing-slider';
import { AXIS_NAMES } from '@/lib/axes';
import { AXES, type Axis } from '../search';
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
      <SmoothingSlider weight={weight} onWeight={onWeight} />
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
