/** Type a few letters of what is wanted, choose, be there. A combobox: the focus stays in the field. */
import { Modal, TextInput } from '@mantine/core';
import { type KeyboardEvent, useEffect, useId, useRef, useState } from 'react';
import { Icon } from '@/components/icon';
import { CommandList } from './command-list';
import { type Command, fittingGroups } from './commands';
import classes from './palette.module.css';
import { useCommands } from './use-commands';

interface Props {
  onClose: () => void;
  onShowShortcuts: () => void;
}

export function CommandPalette({ onClose, onShowShortcuts }: Props) {
  const id = useId();
  const list = useRef<HTMLDivElement>(null);
  const [text, setText] = useState('');
  const [marked, setMarked] = useState(0);
  const found = useCommands(text, onShowShortcuts);
  const groups = fittingGroups(found.groups, text);
  const commands = groups.flatMap((group) => group.commands);
  const at = Math.min(marked, commands.length - 1);
  useEffect(() => {
    list.current?.querySelector(`[data-at="${at}"]`)?.scrollIntoView({ block: 'nearest' });
  }, [at]);
  // A command may open something in the palette's place, so the palette goes first.
  const perform = (command: Command | undefined): void => {
    if (command === undefined) return;
    onClose();
    command.perform();
  };
  const press = (event: KeyboardEvent): void => {
    const last = commands.length - 1;
    const next = { ArrowDown: at === last ? 0 : at + 1, ArrowUp: at <= 0 ? last : at - 1 }[event.key];
    if (event.key === 'Enter' && !event.nativeEvent.isComposing) perform(commands[at]);
    else if (next !== undefined) setMarked(next);
    else return;
    event.preventDefault();
  };
  return (
    <Modal
      opened
      onClose={onClose}
      title="Find anything"
      size="lg"
      yOffset="10dvh"
      closeButtonProps={{ 'aria-label': 'Close' }}
    >
      <TextInput
        data-autofocus
        role="combobox"
        aria-label="A page, a run, a study, or what to launch"
        aria-expanded
        aria-autocomplete="list"
        aria-controls={`${id}-list`}
        aria-activedescendant={at >= 0 ? `${id}-${at}` : undefined}
        placeholder="A page, a run, a study, or what to launch"
        leftSection={<Icon name="search" size={15} />}
        autoComplete="off"
        spellCheck={false}
        value={text}
        onChange={(event) => {
          setText(event.currentTarget.value);
          setMarked(0);
        }}
        onKeyDown={press}
      />
      <CommandList id={id} groups={groups} at={at} ref={list} onMark={setMarked} onPerform={perform} />
      <p className={classes.count} role="status">
        {describeCount(commands.length, found.isLooking)}
      </p>
    </Modal>
  );
}

function describeCount(count: number, isLooking: boolean): string {
  if (count > 0) return `${count} to choose from`;
  return isLooking ? 'Looking among the runs …' : 'Nothing fits. Try a task, a method or a name.';
}
