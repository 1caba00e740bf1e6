/** Take the comparison along: figures for a paper, the numbers behind them, or everything in one archive. */
import { Button, Popover, SegmentedControl, Switch } from '@mantine/core';
import { useState } from 'react';
import { Icon } from '@/components/icon';
import { bundleAddress, FORMATS, type Format, figureAddress, WIDTHS, type Width } from '../exports';
import type { CompareSearch } from '../search';
import classes from './controls.module.css';

const WIDTH_NAMES: Record<Width, string> = { single: 'One column', double: 'Two columns', slide: 'Slide' };

const FORMAT_NAMES: Record<Format, string> = { svg: 'SVG', pdf: 'PDF', png: 'PNG', csv: 'CSV', tex: 'LaTeX table' };

export function ExportMenu({ search }: { search: CompareSearch }) {
  const [width, setWidth] = useState<Width>('double');
  const [isAnonymous, setAnonymous] = useState(false);
  return (
    <Popover width={300} position="bottom-end" trapFocus withArrow shadow="md">
      <Popover.Target>
        <Button size="xs" leftSection={<Icon name="download" size={14} />}>
          Export
        </Button>
      </Popover.Target>
      <Popover.Dropdown aria-label="Export">
        <p className={classes.exportHead}>What this page shows now, without zoom and smoothing</p>
        <SegmentedControl
          size="xs"
          fullWidth
          aria-label="Width"
          value={width}
          onChange={(next) => setWidth(next as Width)}
          data={WIDTHS.map((value) => ({ value, label: WIDTH_NAMES[value] }))}
        />
        <div className={classes.formats}>
          {FORMATS.map((format) => (
            <Button
              key={format}
              component="a"
              href={figureAddress(search, format, width)}
              download
              variant="default"
              size="xs"
            >
              {FORMAT_NAMES[format]}
            </Button>
          ))}
        </div>
        <p className={classes.exportHead}>Everything in one archive</p>
        <p className="faint">Figures, numbers, configs, versions, seeds and BibTeX.</p>
        <Switch
          size="xs"
          my={8}
          label="Anonymous: no hosts, paths or ids"
          checked={isAnonymous}
          onChange={(event) => setAnonymous(event.currentTarget.checked)}
        />
        <Button
          component="a"
          href={bundleAddress(search, width, isAnonymous)}
          download
          variant="default"
          size="xs"
          leftSection={<Icon name="download" size={13} />}
        >
          Bundle
        </Button>
      </Popover.Dropdown>
    </Popover>
  );
}
