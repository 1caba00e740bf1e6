/** Copy a text, and say whether it was copied. */
import { Button } from '@mantine/core';
import { useEffect, useState } from 'react';
import { Icon } from '@/components/icon';
import { useToast } from '@/components/toasts';
import { copyText } from '@/lib/clipboard';

/** How long the button says that it was done [ms]. */
const SAID_MS = 1500;

export function CopyButton({ text, label }: { text: string; label: string }) {
  const toast = useToast();
  const [isCopied, setCopied] = useState(false);
  useEffect(() => {
    if (!isCopied) return;
    const timer = setTimeout(() => setCopied(false), SAID_MS);
    return () => clearTimeout(timer);
  }, [isCopied]);
  const copy = async (): Promise<void> => {
    const isDone = await copyText(text);
    setCopied(isDone);
    if (!isDone) {
      toast({ text: 'The browser does not let the page copy. Select the text and copy it by hand.', isProblem: true });
    }
  };
  return (
    <Button
      variant="default"
      size="compact-xs"
      leftSection={<Icon name={isCopied ? 'succeeded' : 'copy'} size={12} />}
      onClick={() => void copy()}
    >
      {isCopied ? 'Copied' : label}
    </Button>
  );
}
