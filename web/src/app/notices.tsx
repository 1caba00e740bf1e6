/** Lets the browser tell what happens while the page is open. */
import { useNavigate } from '@tanstack/react-router';
import { useDesktopNotices } from '@/components/desktop-notices';

export function Notices() {
  const navigate = useNavigate();
  useDesktopNotices((path) => void navigate({ to: path }));
  return null;
}
