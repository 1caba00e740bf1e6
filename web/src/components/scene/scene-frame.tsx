/** The 3D page of a session in a frame of ours, light or dark as the page around it. */
import { useComputedColorScheme } from '@mantine/core';
import classes from './scene.module.css';

export function SceneFrame({ url, title }: { url: string; title: string }) {
  const scheme = useComputedColorScheme('light');
  return (
    <iframe
      className={classes.frame}
      title={title}
      src={scheme === 'dark' ? `${url}?darkMode` : url}
      sandbox="allow-scripts allow-same-origin allow-downloads"
      allow="fullscreen"
    />
  );
}
