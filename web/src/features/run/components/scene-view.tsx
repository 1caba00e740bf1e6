/** A 3D view that is open: the scene, the bar that drives it, what its kind can do, and its curves. */
import { Button } from '@mantine/core';
import { SceneFrame } from '@/components/scene/scene-frame';
import { TimelinesPanel } from '@/components/scene/timelines-panel';
import { TransportBar } from '@/components/scene/transport-bar';
import { useSceneControl } from '@/lib/use-scene-control';
import { CameraInset } from './camera-inset';
import classes from './run.module.css';
import { SceneExtras } from './scene-extras';

interface Props {
  url: string;
  message: string;
  /** The recorded episode that is shown, if it is one: MuJoCo's own camera can stand beside it. */
  recorded?: { readonly runId: string; readonly epoch: number; readonly number: number };
  onClose: () => void;
}

export function SceneView({ url, message, recorded, onClose }: Props) {
  const scene = useSceneControl(url);
  return (
    <section aria-label="3D view">
      <div className={classes.viewerHead}>
        <span className="faint">{message}</span>
        <Button variant="default" size="compact-xs" onClick={onClose}>
          Close
        </Button>
      </div>
      <SceneFrame url={url} title="3D view" />
      {scene.state && (
        <>
          <TransportBar state={scene.state} tell={scene.tell} />
          <SceneExtras state={scene.state} scene={scene} />
          {scene.problem && (
            <p className="problem" role="alert">
              {scene.problem}
            </p>
          )}
          {recorded && <CameraInset {...recorded} step={scene.state.step} />}
          <TimelinesPanel scene={scene} />
        </>
      )}
    </section>
  );
}
