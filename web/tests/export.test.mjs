// SPDX-License-Identifier: Apache-2.0
// What is shown, as files.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openPage, root, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

test('a run is exported as PNG, SVG, CSV, MP4 and GIF', async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const { page, complaints, close } = await openPage(browser, lab.url);
  await page.waitForSelector('.form .field', { state: 'attached' });
  await page.getByRole('tab', { name: 'Record' }).click();
  const press = (name) => page.getByRole('button', { name, exact: true }).click();
  const file = async (name) => {
    const [download] = await Promise.all([page.waitForEvent('download', { timeout: 60_000 }), press(name)]);
    const to = join(root, 'build/web', `export-${download.suggestedFilename()}`);
    await download.saveAs(to);
    return readFileSync(to);
  };
  await page.selectOption('.timebar .speed', '0');
  await page.click('.play');
  await page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
  assert.equal((await file('PNG')).subarray(1, 4).toString(), 'PNG');
  const svg = (await file('SVG')).toString();
  assert.match(svg, /^<\?xml[\s\S]*<svg[\s\S]*<\/svg>/);
  assert.doesNotMatch(svg, /<image/);
  const lines = (await file('CSV')).toString().trim().split('\n');
  assert.match(lines[0], /^t_s,x_um,y_um,clearance_um/);
  assert.equal(lines.length - 1, await page.evaluate(() => window.microswarm.connection.history.times.length));
  const video = await file('MP4');
  assert.equal(video.subarray(4, 8).toString(), 'ftyp');
  assert.ok(video.length > 10_000);
  await page.getByLabel('from s').fill('1');
  await page.getByLabel('to s').fill('2');
  const gif = await file('GIF');
  assert.equal(gif.subarray(0, 6).toString(), 'GIF89a');
  await page.getByLabel('to s').fill('0.5');
  await press('GIF');
  await until(page, () => document.querySelector('.exports output').value.includes('nothing to show'));
  assert.equal(complaints.splice(0).length, 1);
  await close();
  assert.equal(await lab.stop(), 0);
});
