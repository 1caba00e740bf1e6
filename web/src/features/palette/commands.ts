/** What the palette offers, and which of it fits what was typed. */

/** One thing that can be done from anywhere. */
export interface Command {
  readonly id: string;
  readonly label: string;
  /** What is said behind the label. */
  readonly note?: string;
  /** Further words by which it is found. */
  readonly words?: string;
  readonly perform: () => void;
}

export interface CommandGroup {
  readonly title: string;
  readonly commands: readonly Command[];
  /** Whether the server has chosen them by what was typed, so that they all fit. */
  readonly isFound?: boolean;
  /** Whether they are too many to be offered before something was typed. */
  readonly isLong?: boolean;
}

/** Commands of a group that are shown at once. */
export const MOST_SHOWN = 8;

/** The groups with the commands that have all words of the text; labels that begin with it come first. */
export function fittingGroups(groups: readonly CommandGroup[], text: string): CommandGroup[] {
  const typed = text.trim().toLowerCase();
  const words = typed.split(/\s+/).filter(Boolean);
  const fits = ({ label, note = '', words: more = '' }: Command): boolean => {
    const said = `${label} ${note} ${more}`.toLowerCase();
    return words.every((word) => said.includes(word));
  };
  return groups.flatMap((group) => {
    if (group.isLong && typed === '') return [];
    const fitting = group.isFound ? [...group.commands] : group.commands.filter(fits);
    const begins = ({ label }: Command): number => (label.toLowerCase().startsWith(typed) ? 0 : 1);
    fitting.sort((one, other) => begins(one) - begins(other));
    return fitting.length > 0 ? [{ ...group, commands: fitting.slice(0, MOST_SHOWN) }] : [];
  });
}
