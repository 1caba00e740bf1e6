/** How much curves are smoothed. */
import { Slider } from '@mantine/core';
import { MOST_SMOOTHING } from '@/lib/smoothing';
import classes from './smoothing-slider.module.css';

export function SmoothingSlider({ weight, onWeight }: { weight: number; onWeight: (weight: number) => void }) {
  return (
    <div className={classes.smoothing}>
      <span>Smoothing</span>
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
  );
}
