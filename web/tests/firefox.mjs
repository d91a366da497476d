// SPDX-License-Identifier: Apache-2.0
// Debian's Firefox, driven by WebDriver BiDi, which it speaks itself: Playwright's older protocol needs its own builds.
import { spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import playwright from 'playwright-core';

const firefox = '/usr/bin/firefox-esr';
const screen = '/usr/bin/Xvfb'; // without a screen Firefox has no WebGL

/** Why there is no Firefox to test with; undefined if there is one. */
export const lacking = [firefox, screen].find((one) => !existsSync(one));

/** Firefox, and the function that ends it. */
export async function startFirefox() {
  const server = spawn(screen, ['-displayfd', '3', '-nolisten', 'tcp'], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe'],
  });
  process.on('exit', () => server.kill());
  const display = await new Promise((resolve, reject) => {
    server.stdio[3].once('data', (text) => resolve(String(text).trim()));
    server.once('exit', () => reject(new Error('Xvfb does not start')));
  });
  const env = { ...process.env, DISPLAY: `:${display}` };
  const browser = await playwright._bidiFirefox.launch({ executablePath: firefox, env });
  const end = async () => {
    await browser.close();
    server.kill();
  };
  return { browser, end };
}
