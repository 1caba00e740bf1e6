/** Send a study file to the server, and tell how much of it has gone out. */
import { useMutation, useQueryClient } from '@tanstack/react-query';
import { useState } from 'react';
import type { StudyImport } from '@/client/schema.gen';
import { problemsOf, Refused, Unreachable } from '@/lib/api';

/** The server takes no larger file [MB]; said before a long wait, as it would be after it. */
const LARGEST_MB = 512;

/** @returns the mutation, and the share that has gone out, 0 to 1 */
export function useUploadStudy() {
  const queries = useQueryClient();
  const [share, setShare] = useState(0);
  const uploading = useMutation({
    mutationFn: async (file: File): Promise<StudyImport> => {
      setShare(0);
      if (file.size > LARGEST_MB * 2 ** 20) {
        const size = `${file.name} has ${Math.round(file.size / 2 ** 20)} MB`;
        throw new Refused(413, [{ field: null, message: `${size}; a study file has ${LARGEST_MB} MB at most.` }]);
      }
      return send(file, setShare);
    },
    onSuccess: () => Promise.all([['studies'], ['runs']].map((queryKey) => queries.invalidateQueries({ queryKey }))),
  });
  return { ...uploading, share };
}

/** `fetch` cannot tell how much has been sent, so this is the one request that goes another way. */
function send(file: File, onProgress: (share: number) => void): Promise<StudyImport> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open('POST', '/api/study-files');
    request.setRequestHeader('Content-Type', 'application/zip');
    request.responseType = 'json';
    request.upload.onprogress = ({ loaded, total }) => onProgress(total > 0 ? loaded / total : 0);
    request.onload = () => {
      const { status, response } = request;
      if (status >= 200 && status < 300) resolve(response as StudyImport);
      else reject(new Refused(status, problemsOf(response, status)));
    };
    request.onerror = () => reject(new Unreachable('the connection was cut while the file was sent'));
    request.send(file);
  });
}
