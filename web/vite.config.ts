/** How the page is built, served while developing, and tested. */
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { gzip } from 'node:zlib';
import react from '@vitejs/plugin-react';
import type { Plugin } from 'vite';
import { defineConfig } from 'vitest/config';

const API = process.env.SLDR_API ?? 'http://127.0.0.1:8000';

/** Nearly as small as the smallest, in a quarter of the time. */
const GZIP_LEVEL = 6;

/** Put `file.wasm.gz` beside every `file.wasm`: Rerun's viewer is 47 MB, and the server sends the small one as it is. */
function compressWasm(): Plugin {
  return {
    name: 'compress-wasm',
    apply: 'build',
    async generateBundle(_, bundle) {
      for (const [fileName, file] of Object.entries(bundle)) {
        if (file.type !== 'asset' || !fileName.endsWith('.wasm')) continue;
        const source = await promisify(gzip)(file.source, { level: GZIP_LEVEL });
        this.emitFile({ type: 'asset', fileName: `${fileName}.gz`, source });
      }
    },
  };
}

export default defineConfig({
  plugins: [react(), compressWasm()],
  resolve: { alias: { '@': fileURLToPath(new URL('./src', import.meta.url)) } },
  server: {
    host: '127.0.0.1',
    proxy: { '/api': API, '/healthz': API, '/viewer': { target: API, ws: true } },
  },
  // Vite would bundle the viewer anew without the file that lies beside it.
  optimizeDeps: { exclude: ['@rerun-io/web-viewer'] },
  build: { target: 'es2023' },
  test: {
    environment: 'jsdom',
    isolate: false, // to load React and Mantine anew for each file takes longer than the tests
    setupFiles: ['./src/testing/setup.ts'],
    testTimeout: 20_000, // [ms] two busy cores render a form slowly
  },
});
