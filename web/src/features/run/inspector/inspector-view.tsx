/** The inspector that is open: the scene with its clock, and beside it the fan's map, its failures and the slice of Q. */
import { Button } from '@mantine/core';
import { SceneFrame } from '@/components/scene/scene-frame';
import { TimelinesPanel } from '@/components/scene/timelines-panel';
import { TransportBar } from '@/components/scene/transport-bar';
import { type Scene, useSceneControl } from '@/lib/use-scene-control';
import type { About, InspectorState } from './answers';
import { DemonstrationBar } from './demonstration-bar';
import { FailuresPanel } from './failures-panel';
import { FanBar } from './fan-bar';
import classes from './inspector.module.css';
import { MapPanel } from './map-panel';
import { SlicePanel } from './slice-panel';
import { useAnswer } from './use-answer';

export function InspectorView({ url, message, onClose }: { url: string; message: string; onClose: () => void }) {
  const scene = useSceneControl(url);
  const state = scene.state as InspectorState | undefined;
  const about = useAnswer<About>(scene, { do: 'about', starts: state?.starts }, state === undefined ? null : 0);
  return (
    <section aria-label="Demonstrations">
      <div className={classes.head}>
        <span className="faint">{message}</span>
        <Button variant="default" size="compact-xs" onClick={onClose}>
          Close
        </Button>
      </div>
      <div className={classes.columns}>
        <div className={classes.stage}>
          <SceneFrame url={url} title="3D view of the demonstrations" />
          {state && <TransportBar state={state} tell={scene.tell} />}
          {state && about && <DemonstrationBar scene={scene} state={state} about={about} />}
          {scene.problem && (
            <p className="problem" role="alert">
              {scene.problem}
            </p>
          )}
          <TimelinesPanel scene={scene} />
        </div>
        {state && about && <Panels scene={scene} state={state} about={about} />}
      </div>
    </section>
  );
}

function Panels({ scene, state, about }: { scene: Scene; state: InspectorState; about: About }) {
  return (
    <div className={classes.panels}>
      <FanBar scene={scene} fan={state.fan} about={about} />
      {state.fan !== null && state.fan.done > 0 && (
        <>
          <MapPanel key={state.starts} scene={scene} fan={state.fan} about={about} />
          <FailuresPanel scene={scene} fan={state.fan} shown={state} />
        </>
      )}
      <SlicePanel key={`slice ${state.starts}`} scene={scene} state={state} about={about} />
    </div>
  );
}
