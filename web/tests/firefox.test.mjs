// SPDX-License-Identifier: Apache-2.0
// The main ways in Firefox: gallery, session, play, change, steer, look back, compare, and a record that replays.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { lacking, startFirefox } from './firefox.mjs';
import { openPage, program, startLab, until } from './lab.mjs';

const options = lacking ? { skip: `there is no ${lacking}` } : {};
let browser;
let end = () => undefined;
before(async () => {
  if (!lacking) ({ browser, end } = await startFirefox());
});
after(() => end());

test('from the gallery to a run that is changed, looked back at, and replays identically', options, async () => {
  const folder = mkdtempSync(join(tmpdir(), 'lab-firefox-'));
  const lab = await startLab();
  const { page, close } = await openPage(browser, lab.url);
  await page.locator('.card[data-file$="first_flight.yaml"]').click();
  await page.waitForSelector('.session .form .field', { state: 'attached' });
  await page.locator('.play').click();
  await until(page, () => window.microswarm.connection.standing?.plays);
  await until(page, () => window.microswarm.connection.shown > 1);
  await until(page, () => window.microswarm.scene.pictures > 5);
  await page.locator('[id="field-navigator.speed_um_per_s"]').fill('40,5'); // a decimal comma
  await page.keyboard.press('Enter');
  await until(page, () => window.microswarm.connection.standing.changes.join() === 'navigator.speed_um_per_s=40.5');
  await page.locator('.clock').click(); // away from the field
  await page.keyboard.press('m');
  await until(page, () => window.microswarm.connection.standing.mode === 'manual');
  await page.keyboard.press('m');
  await page.keyboard.press('Space');
  await until(page, () => !window.microswarm.connection.standing.plays);
  await page.keyboard.press('Home');
  await until(page, () => window.microswarm.connection.standing.looks_back);
  await page.locator('.parameters .when', { hasText: 'These are the values at 0.0 s.' }).waitFor();
  await page.keyboard.press('End');
  await until(page, () => !window.microswarm.connection.standing.looks_back);
  await page.getByRole('tab', { name: 'Plots' }).click();
  await page.getByRole('tab', { name: 'Record' }).click();
  await page.locator('.changes', { hasText: 'navigator.speed_um_per_s=40.5' }).waitFor();
  const bytes = await page.evaluate(async () => {
    const response = await fetch(`/api/sessions/${window.microswarm.connection.session}/record.h5`);
    return [...new Uint8Array(await response.arrayBuffer())];
  });
  const record = join(folder, 'record.h5');
  writeFileSync(record, Uint8Array.from(bytes));
  assert.match(execFileSync(program, ['replay', record], { encoding: 'utf8' }), /identical/);
  await page.getByRole('link', { name: '‹ Gallery' }).click();
  await page.locator('.loss .anew').click();
  await page.locator('.open-runs a', { hasText: 'changed' }).waitFor();
  await close();
  assert.equal(await lab.stop(), 0);
  rmSync(folder, { recursive: true });
});

test('an obstacle is dragged, and two runs stand side by side', options, async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const { page, close } = await openPage(browser, lab.url);
  await page.waitForSelector('.session .form .field', { state: 'attached' });
  await until(page, () => window.microswarm.scene.motion.newest.discs.length > 0);
  const [from, to] = await page.evaluate(() => {
    const { scene } = window.microswarm;
    const { discs } = scene.motion.newest;
    const box = document.querySelector('.scene canvas').getBoundingClientRect();
    const { x, y, scale } = scene.view;
    return [
      [discs[0], discs[1]],
      [discs[0] - 100, discs[1] + 200],
    ].map(([a, b]) => [box.x + x + scale * a, box.y + y - scale * b]);
  });
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(...to, { steps: 5 });
  await page.mouse.up();
  await until(page, () => /^obstacles\.0\.motion/.test(window.microswarm.connection.standing.changes.join()));
  await page.getByRole('tab', { name: 'Record' }).click();
  await page.locator('.record .compare').click();
  await page.waitForSelector('.side[data-side="B"] .scene canvas');
  await page.locator('.play').click();
  await until(page, () => Number(document.querySelector('tr[data-metric="time_s"] td')?.textContent) > 0.5);
  await page.locator('.play').click();
  await close();
  assert.equal(await lab.stop(), 0);
});
