/** The Rerun file of a run: which one to open, and with what. */
import type { RunFile } from '@/client/schema.gen';

/** The one version of Rerun that reads our files, here and on a desk. */
export const RERUN_VERSION = '0.33.0';

const SUFFIX = '.rrd';

export function isRecording(file: { readonly name: string }): boolean {
  return file.name.endsWith(SUFFIX);
}

/** The recording that was written last: each attempt writes one, with all that was before it. */
export function newestRecording(files: readonly RunFile[] | undefined): RunFile | undefined {
  return files
    ?.filter(isRecording)
    .toSorted((one, other) => one.created_at.localeCompare(other.created_at))
    .at(-1);
}

/** The address of exactly these bytes: a renewed recording has another one. */
export function versionUrl(file: RunFile, origin: string): string {
  return `${origin}${file.url}?version=${file.sha256.slice(0, 12)}`;
}

/** What a person types to open a downloaded recording. */
export function openCommand(file: { readonly name: string }): string {
  return `rerun ${file.name}`;
}
