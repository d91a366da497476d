// SPDX-License-Identifier: Apache-2.0
// The state of a rig's queue in the gallery.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openPage, program, root, startBrowser, startLab } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

test('the gallery shows a queue and what becomes of it', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'microswarm-queue-'));
  const scenario = join(root, 'scenarios/first_rig.yaml');
  writeFileSync(join(folder, 'queue.yaml'), `time_budget_s: 1\nentries: [{scenario: ${scenario}, repeat: 2}]\n`);
  const rig = join(root, 'scenarios/rigs/vortex.yaml');
  const lab = await startLab('--queue', folder);
  const lookedAt = await openPage(browser, lab.url);
  const { page } = lookedAt;
  await page.locator('.queue .doing', { hasText: 'no queue has begun' }).waitFor();
  const queue = spawn(program, ['rig', 'queue', join(folder, 'queue.yaml'), '--rig', rig, '--out', folder]);
  const ended = new Promise((resolve) => queue.on('exit', resolve));
  await page.locator('.queue[data-active="yes"] tr[data-state="running"]').first().waitFor({ timeout: 60_000 });
  assert.equal(await ended, 0);
  await page.locator('.queue[data-active="no"] tr[data-state="done"]').nth(1).waitFor();
  assert.match(await page.locator('.queue .doing').innerText(), /2 of 2 done.*no program/);
  await lookedAt.picture('queue');
  const told = JSON.parse(execFileSync(program, ['rig', 'queue', '--status', folder, '--json']));
  assert.equal(told.items.length, 2);
  await lookedAt.close();
  await lab.stop();
  rmSync(folder, { recursive: true });
});
