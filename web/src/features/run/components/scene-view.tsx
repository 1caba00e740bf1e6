/** A 3D view that is open: the scene, the bar that drives it, what its kind can do, and its curves. */
import { Button } from '@mantine/core';
import { SceneFrame } from '@/components/scene/scene-frame';
import { TimelinesPanel } from '@/components/scene/timelines-panel';
import { TransportBar } from '@/components/scene/transport-bar';
import { useSceneControl } from '@/lib/use-scene-control';
import classes from './run.module.css';
import { SceneExtras } from './scene-extras';

export function SceneView({ url, message, onClose }: { url: string; message: string; onClose: () => void }) {
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
          <TimelinesPanel scene={scene} />
        </>
      )}
    </section>
  );
}
