/** The sizes and forms in which videos are offered. */

export interface Size {
  readonly width: number; // [px]
  readonly height: number; // [px]
}

/** All multiples of 8: encoders stretch what is not. */
export const SIZES = {
  small: { width: 480, height: 360 },
  medium: { width: 640, height: 480 },
  large: { width: 1280, height: 960 },
} as const satisfies Record<string, Size>;
export type SizeName = keyof typeof SIZES;

/** What the camera beside a 3D scene shows. */
export const INSET: Size = { width: 320, height: 240 };

export function isInset({ width, height }: Size): boolean {
  return width === INSET.width && height === INSET.height;
}

export const FORMATS = ['mp4', 'webm'] as const;
export type Format = (typeof FORMATS)[number];

/** Frames of a second: one for each control step of 0.04 s. */
const FRAMES_PER_S = 25;

/** Where in a video a step of its episode stands, in the middle of its frame [s]. */
export function timeOfStep(step: number): number {
  return (step + 0.5) / FRAMES_PER_S;
}

/** The step that a video shows at a time [s]. */
export function stepAtTime(seconds: number): number {
  return Math.floor(seconds * FRAMES_PER_S);
}
