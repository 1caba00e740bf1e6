/** Everything that can be done from the palette: pages, launches, runs, studies, the look. */
import { useMantineColorScheme } from '@mantine/core';
import { useDebouncedValue } from '@mantine/hooks';
import { keepPreviousData, useQuery } from '@tanstack/react-query';
import { useNavigate } from '@tanstack/react-router';
import type { Choices, RunSummary, StudySummary } from '@/client/schema.gen';
import { useMay } from '@/lib/access';
import { client, unwrap } from '@/lib/api';
import { ACCOUNT, PLACES } from '@/lib/places';
import { choicesQuery } from '@/lib/queries';
import { runTitle } from '@/lib/run-title';
import { describeAxes, studiesQuery } from '@/lib/studies';
import { type Command, type CommandGroup, MOST_SHOWN } from './commands';

/** Rest after the last key before the server is asked [ms]. */
const TYPING_REST_MS = 200;

type Navigate = ReturnType<typeof useNavigate>;

interface Found {
  readonly groups: CommandGroup[];
  /** Whether the server has still to say which runs fit. */
  readonly isLooking: boolean;
}

export function useCommands(text: string, onShowShortcuts: () => void): Found {
  const navigate = useNavigate();
  const mayLaunch = useMay('operator');
  const choices = useQuery(choicesQuery).data;
  const [asked] = useDebouncedValue(text.trim(), TYPING_REST_MS);
  const found = useQuery(foundRunsQuery(asked));
  const runs = found.data?.runs ?? [];
  const studies = useQuery(studiesQuery(false)).data?.studies ?? [];
  // Until the answer to what stands there now has come, an older one may hold what does not fit.
  const isFound = asked === text.trim() && !found.isPlaceholderData;
  const groups = [
    { title: 'Pages', commands: pages(navigate, mayLaunch) },
    { title: 'Launch', commands: choices && mayLaunch ? launches(choices, navigate) : [], isLong: true },
    {
      title: asked === '' ? 'Newest runs' : 'Runs',
      commands: runs.map((run) => openRun(run, navigate)),
      isFound,
    },
    { title: 'Studies', commands: studies.map((study) => openStudy(study, navigate)) },
    { title: 'Look and help', commands: useLook(onShowShortcuts) },
  ];
  return { groups, isLooking: !isFound || found.isPending };
}

/** The newest runs, or those that the server finds for a text. */
function foundRunsQuery(text: string) {
  const query = { limit: MOST_SHOWN, search: text || undefined };
  return {
    queryKey: ['runs', 'found', text],
    queryFn: ({ signal }: { signal: AbortSignal }) => unwrap(client.GET('/api/runs', { params: { query }, signal })),
    placeholderData: keepPreviousData,
  };
}

function pages(navigate: Navigate, mayLaunch: boolean): Command[] {
  const shown = [...PLACES, ACCOUNT].filter(({ to }) => mayLaunch || to !== '/launch');
  const places = shown.map(({ to, label, key }) => ({
    id: `page ${to}`,
    label,
    note: `g ${key}`,
    words: 'go to page',
    perform: () => void navigate({ to }),
  }));
  if (!mayLaunch) return places;
  const newStudy = { id: 'page /studies/new', label: 'New study', words: 'go to page launch compare' };
  return [...places, { ...newStudy, perform: () => void navigate({ to: '/studies/new' }) }];
}

/** The form of a new run, filled in; nothing is queued before somebody has looked. */
function launches({ tasks, methods }: Choices, navigate: Navigate): Command[] {
  return tasks.flatMap(({ name: task, goal_text }) =>
    methods.map(({ name: method, title, phases }) => ({
      id: `launch ${task} ${method}`,
      label: `Launch ${task} with ${method}`,
      note: title,
      words: goal_text,
      perform: () =>
        void navigate({
          to: '/launch',
          search: { task, method, phase: phases.includes('manipulation') ? 'manipulation' : 'locomotion' },
        }),
    })),
  );
}

function openRun(run: RunSummary, navigate: Navigate): Command {
  return {
    id: `run ${run.id}`,
    label: runTitle(run),
    note: `${run.state}, ${run.preset}`,
    perform: () => void navigate({ to: '/runs/$runId', params: { runId: run.id } }),
  };
}

function openStudy({ id, name, note, spec }: StudySummary, navigate: Navigate): Command {
  return {
    id: `study ${id}`,
    label: name,
    note: describeAxes(spec),
    words: note,
    perform: () => void navigate({ to: '/studies/$studyId', params: { studyId: id } }),
  };
}

function useLook(onShowShortcuts: () => void): Command[] {
  const { colorScheme, setColorScheme } = useMantineColorScheme();
  const schemes = [
    { scheme: 'light', label: 'Light colours' },
    { scheme: 'dark', label: 'Dark colours' },
    { scheme: 'auto', label: 'Colours of the system' },
  ] as const;
  return [
    { id: 'shortcuts', label: 'Show shortcuts', note: '?', words: 'keyboard keys help', perform: onShowShortcuts },
    ...schemes.map(({ scheme, label }) => ({
      id: `scheme ${scheme}`,
      label,
      note: scheme === colorScheme ? 'as it is now' : undefined,
      words: 'theme scheme switch',
      perform: () => setColorScheme(scheme),
    })),
  ];
}
