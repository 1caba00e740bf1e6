/** A field for tags: those in use are offered, new ones are typed. */
import { TagsInput } from '@mantine/core';
import { useQuery } from '@tanstack/react-query';
import type { Ref } from 'react';
import { LONGEST_TAG, tagsQuery } from '@/lib/labels';

interface Props {
  label: string;
  value: readonly string[];
  onChange: (tags: string[]) => void;
  /** Offered instead of all tags in use. */
  known?: readonly string[];
  placeholder?: string;
  ref?: Ref<HTMLInputElement>;
}

export function TagField({ label, value, onChange, known, placeholder, ref }: Props) {
  const { data } = useQuery(tagsQuery);
  return (
    <TagsInput
      ref={ref}
      size="xs"
      label={label}
      placeholder={value.length === 0 ? placeholder : undefined}
      data={[...(known ?? data?.tags.map(({ tag }) => tag) ?? [])]}
      value={[...value]}
      onChange={(tags) => onChange(tags.map((tag) => tag.trim().slice(0, LONGEST_TAG)).filter(Boolean))}
      splitChars={[',']}
      acceptValueOnBlur
      clearable
      // Inside a popover: a list of its own layer would count as outside and close it.
      comboboxProps={{ withinPortal: false }}
    />
  );
}
