/** Put a study together: what is compared, what that means, launch it. */
import { Button } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { getRouteApi } from '@tanstack/react-router';
import type { Choices, StudyTemplate } from '@/client/schema.gen';
import { SentencePanel } from '@/components/sentence-panel';
import { sentence } from '@/lib/api';
import { choicesQuery } from '@/lib/queries';
import { reconnecting } from '@/lib/reconnecting';
import { studyQuery, templatesQuery } from '@/lib/studies';
import { Builder } from './components/builder';
import { type Draft, draftOf } from './use-draft';

const route = getRouteApi('/studies/new');

export function NewStudyPage() {
  const { template, from } = route.useSearch();
  const beginning = `${template} ${from}`;
  const choices = useQuery(choicesQuery);
  const templates = useQuery(templatesQuery);
  const cloned = useQuery({ ...studyQuery(from ?? ''), enabled: from !== undefined, refetchInterval: reconnecting });
  const parts = from === undefined ? [choices, templates] : [choices, templates, cloned];
  const error = parts.find((part) => part.error && !part.data)?.error;
  const isThere = choices.data && templates.data && (from === undefined || cloned.data);
  return (
    <>
      <title>New study · SLDR</title>
      <div className="page-head">
        <h1>New study</h1>
      </div>
      {error && (
        <SentencePanel
          urgent
          title="The choices cannot be shown"
          actions={
            <Button onClick={() => parts.forEach((part) => void (part.error && part.refetch()))}>Try again</Button>
          }
        >
          {sentence(error)}
        </SentencePanel>
      )}
      {!error && !isThere && <p className="faint">Looking…</p>}
      {isThere && choices.data && templates.data && (
        <Builder
          key={beginning}
          choices={choices.data}
          templates={templates.data.templates}
          beginning={beginning}
          begin={beginWith(choices.data, templates.data.templates, template, cloned.data)}
        />
      )}
    </>
  );
}

function beginWith(
  choices: Choices,
  templates: readonly StudyTemplate[],
  wanted: string | undefined,
  cloned: { name: string; spec: StudyTemplate['spec'] } | undefined,
): Draft {
  if (cloned) return draftOf(cloned.spec, `Copy of ${cloned.name}`.slice(0, 80));
  const template = templates.find(({ name }) => name === wanted);
  if (template) return draftOf(template.spec, template.title);
  const known = choices.methods.map(({ name }) => name);
  return {
    name: '',
    tasks: choices.tasks.slice(0, 1).map(({ name }) => name),
    methods: ['her', 'her-sldr'].filter((name) => known.includes(name)),
    seeds: '0-2',
    locomotion: 'zoo',
    preset: choices.presets.some(({ name }) => name === 'quick') ? 'quick' : (choices.presets[0]?.name ?? ''),
    rows: [],
    variants: [],
  };
}
