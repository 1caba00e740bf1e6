/** Copy a text, and say that it was copied. */
import { Button } from '@mantine/core';
import { useClipboard } from '@mantine/hooks';
import { Icon } from '@/components/icon';

export function CopyButton({ text, label }: { text: string; label: string }) {
  const { copied, copy } = useClipboard({ timeout: 1500 });
  return (
    <Button
      variant="default"
      size="compact-xs"
      leftSection={<Icon name={copied ? 'succeeded' : 'copy'} size={12} />}
      onClick={() => copy(text)}
    >
      {copied ? 'Copied' : label}
    </Button>
  );
}
