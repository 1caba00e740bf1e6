/** Which runs a question to the server is about. */
import { type CompareSearch, partsOf } from '../search';

/** The runs that the page is narrowed to, as every route of comparisons takes them. */
export function choiceOf({ study, phase, tasks, methods, preset, runs }: CompareSearch) {
  return {
    study,
    phase,
    task: [...partsOf(tasks)],
    method: [...partsOf(methods)],
    preset: preset === undefined ? [] : [preset],
    run: [...partsOf(runs)],
  };
}
