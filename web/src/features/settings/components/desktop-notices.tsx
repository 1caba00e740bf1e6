/** Whether this browser shows a notification when a study ends or a run fails. */
import { Switch } from '@mantine/core';
import { useState } from 'react';
import { CardSection } from '@/components/card-section';
import { canNotify, useNoticesWanted } from '@/components/desktop-notices';

export function DesktopNotices() {
  const [isWanted, want] = useNoticesWanted();
  const [isDenied, setDenied] = useState(canNotify() && Notification.permission === 'denied');
  const change = async (wanted: boolean): Promise<void> => {
    const permission = wanted ? await Notification.requestPermission() : 'granted';
    setDenied(permission === 'denied');
    want(wanted && permission === 'granted');
  };
  return (
    <CardSection title="Notifications of this browser">
      {canNotify() ? (
        <Switch
          label="Show a notification when a study ends or a run fails"
          description="As long as this page is open in some tab."
          checked={isWanted && !isDenied}
          onChange={(event) => void change(event.currentTarget.checked)}
        />
      ) : (
        <p className="faint">This browser shows notifications only for pages on this machine or over HTTPS.</p>
      )}
      {isDenied && (
        <p className="problem">The browser forbids it; allow notifications for this page in its settings.</p>
      )}
    </CardSection>
  );
}
