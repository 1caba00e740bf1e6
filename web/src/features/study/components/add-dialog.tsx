/** More seeds, tasks, methods or variants for a study; says what that would queue before it is done. */
import { Button, Group, Input, Modal, MultiSelect, Stack, TextInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import { useMemo, useState } from 'react';
import type { StudyDetail } from '@/client/schema.gen';
import { PreviewSums } from '@/components/preview-sums';
import { SettingField } from '@/components/setting-field';
import { sentence } from '@/lib/api';
import { choicesQuery } from '@/lib/queries';
import { MOST_STUDY_SEEDS, parseSeeds } from '@/lib/seeds';
import { leaves, readVariants } from '@/lib/setting-rows';
import { readSettingGroups } from '@/lib/settings';
import { previewQuery } from '@/lib/study-preview';
import { useDialogWish } from '../use-dialog-wish';

interface Props {
  study: StudyDetail;
  isOpen: boolean;
  onClose: () => void;
}

export function AddDialog({ study, isOpen, onClose }: Props) {
  return (
    <Modal opened={isOpen} onClose={onClose} title="Add to the study" centered>
      {isOpen && <Form study={study} onClose={onClose} />}
    </Modal>
  );
}

function Form({ study, onClose }: Omit<Props, 'isOpen'>) {
  // Once the new runs are queued they belong to the study; the dialog then still says what it was asked for.
  const [spec] = useState(study.spec);
  const { send, error, isPending } = useDialogWish(onClose);
  const { data: choices } = useQuery(choicesQuery);
  const [seedText, setSeedText] = useState(String(Math.max(...spec.seeds) + 1));
  const [tasks, setTasks] = useState<string[]>([]);
  const [methods, setMethods] = useState<string[]>([]);
  const groups = useMemo(() => readSettingGroups(choices?.config_schema ?? {}), [choices]);
  const [varied, setVaried] = useState({
    path: leaves(spec.variants?.at(-1)?.overrides ?? {})[0]?.[0] ?? '',
    text: '',
  });
  const read = readSeeds(seedText);
  const seeds = read.seeds.filter((seed) => !spec.seeds.includes(seed));
  const { variants, problem } = readVariants(groups, varied);
  const isEmpty = seeds.length + tasks.length + methods.length + variants.length === 0;
  const isUnread = read.problem !== undefined || problem !== undefined;
  const longer = {
    ...spec,
    seeds: [...spec.seeds, ...seeds],
    tasks: [...spec.tasks, ...tasks],
    methods: [...spec.methods, ...methods],
    variants: [...(spec.variants ?? []), ...variants],
  };
  const preview = useQuery(previewQuery(isEmpty || isUnread || isPending ? null : longer, study.id));
  const isPreviewed = preview.data !== undefined && !preview.isPlaceholderData;
  const others = (names: readonly { name: string }[] = [], known: readonly string[] = []): string[] =>
    names.map(({ name }) => name).filter((name) => !known.includes(name));
  return (
    <Stack gap="sm">
      <TextInput
        label="Seeds"
        description={`There are ${spec.seeds.join(', ')}. Add 5, or 5-9; leave it empty to add none.`}
        value={seedText}
        error={read.problem}
        data-autofocus
        onChange={(event) => setSeedText(event.currentTarget.value)}
      />
      <MultiSelect label="Tasks" data={others(choices?.tasks, spec.tasks)} value={tasks} onChange={setTasks} />
      <MultiSelect
        label="Methods"
        data={others(choices?.methods, spec.methods)}
        value={methods}
        onChange={setMethods}
      />
      {spec.variants && spec.variants.length > 0 && (
        <Input.Wrapper
          label="Variants"
          description={`There are ${spec.variants.map(({ name }) => name).join(', ')}. Each value of a setting is one more.`}
        >
          <Stack gap={6} mt={6}>
            <SettingField label="Setting to vary" groups={groups} row={varied} problem={problem} onChange={setVaried} />
          </Stack>
        </Input.Wrapper>
      )}
      {isEmpty && !isUnread && <p className="faint">The study has all of that already.</p>}
      {preview.data && !isEmpty && <PreviewSums preview={preview.data} />}
      {preview.error && <p className="problem">{sentence(preview.error)}</p>}
      {error && (
        <p className="problem" role="alert">
          {sentence(error)}
        </p>
      )}
      <Group justify="flex-end" gap="xs">
        <Button variant="default" onClick={onClose}>
          Leave it
        </Button>
        <Button
          disabled={isEmpty || isUnread || preview.isError || !isPreviewed}
          loading={isPending}
          onClick={() => send({ action: 'extend', studyId: study.id, addition: { seeds, tasks, methods, variants } })}
        >
          Add and queue
        </Button>
      </Group>
    </Stack>
  );
}

function readSeeds(text: string): { seeds: number[]; problem?: string } {
  if (text.trim() === '') return { seeds: [] };
  try {
    return { seeds: parseSeeds(text, MOST_STUDY_SEEDS) };
  } catch (error) {
    return { seeds: [], problem: (error as Error).message };
  }
}
