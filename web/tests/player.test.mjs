// SPDX-License-Identifier: Apache-2.0
// A run as one file, opened from the disk: no server, no network.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { after, before, test } from 'node:test';
import { openPage, program, root, startBrowser, until } from './lab.mjs';

let browser;
let folder;
before(async () => {
  browser = await startBrowser();
  folder = mkdtempSync(join(tmpdir(), 'microswarm-player-'));
});
after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

function microswarm(...words) {
  const { status, stderr } = spawnSync(program, words, { cwd: root, encoding: 'utf8' });
  assert.ok(status === 0 || status === 3, stderr); // 3: the time limit
}

/** Writes the page of a scenario's run; its address. */
function written(scenario, name, ...settings) {
  const out = join(folder, name);
  microswarm('run', scenario, '--out', out, '--no-report', ...settings.flatMap((one) => ['--set', one]));
  microswarm('report', join(out, 'run.h5'), '--page', join(out, 'run.html'));
  return pathToFileURL(join(out, 'run.html')).href;
}

/** Opens it; whatever leaves the page is a complaint. */
async function opened(address, size, scheme = 'light') {
  const all = await openPage(browser, address, size);
  await all.page.emulateMedia({ colorScheme: scheme });
  await until(all.page, () => window.microswarm?.connection.standing !== undefined);
  return all;
}

const seek = async (page, frame) => {
  await page.evaluate((number) => window.microswarm.connection.seek(number), frame);
  await until(page, (number) => window.microswarm.connection.standing.frame === number, { wanted: frame });
};

test('a radar run plays, is sought and shows why it turned, from a file', async () => {
  const address = written('scenarios/papers/radar/twelve.yaml', 'radar', 'record.diagnostics=true', 'time_limit_s=12');
  const { page, picture, close } = await opened(address);
  const frames = await page.evaluate(() => {
    const list = [];
    window.microswarm.connection.listen((message) => message.type === 'frame' && list.push(message));
    window.seen = list;
    return window.microswarm.connection.standing.frames;
  });
  assert.ok(frames > 100);
  await page.keyboard.press(' ');
  await until(page, () => window.microswarm.connection.standing.frame > 5);
  await page.keyboard.press(' ');
  await until(page, () => window.microswarm.connection.standing.plays === false);
  await seek(page, 60);
  const beams = await page.evaluate(() => window.seen.at(-1).radar.beams.length);
  assert.ok(beams > 0);
  assert.equal(await page.locator('.clock').innerText(), '6.0 s');
  await page.getByRole('tab', { name: 'About' }).click();
  await page.locator('.about', { hasText: 'microswarm replay run.h5' }).waitFor();
  await picture('player-about');
  await page.getByRole('tab', { name: 'Plots' }).click();
  await page.locator('.plots canvas').first().waitFor();
  await page.getByRole('tab', { name: 'Layers' }).click();
  await page.locator('[data-layer="clearance"] input').check();
  await page.getByRole('tab', { name: 'Record' }).click();
  await page.locator('.metrics [data-metric="time_s"]').waitFor();
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'CSV' }).click();
  const lines = readFileSync(await (await download).path(), 'utf8')
    .trim()
    .split('\n');
  assert.equal(lines.length, frames + 1);
  // What needs a server or changes the run is not there.
  for (const absent of ['Parameters', 'Steer', 'Compare', 'Gallery', 'MP4', 'SVG', '+ Obstacle', 'record.h5'])
    assert.equal(await page.getByText(absent, { exact: false }).and(page.locator('button, a')).count(), 0, absent);
  await page.getByRole('button', { name: 'Follow' }).click();
  await page.getByRole('tab', { name: 'About' }).click();
  await picture('player');
  await page.getByRole('button', { name: 'Light or dark' }).click();
  await picture('player-dark');
  await close();
});

test('a gathering has its regions at every time, on a phone too', async () => {
  const address = written(
    'scenarios/papers/gather/vascular_network.yaml',
    'gather',
    'record.diagnostics=true',
    'time_limit_s=40',
  );
  const { page, picture, close } = await opened(address, { width: 390, height: 844 });
  const regions = await page.evaluate(async () => {
    const { connection } = window.microswarm;
    let heard = 0;
    connection.listen((message) => (heard += message.type === 'aggregation' ? 1 : 0));
    connection.seek(connection.standing.frames - 1);
    return heard;
  });
  assert.equal(regions, 0, 'they are sent once, with the first frame');
  await picture('player-phone');
  await close();
});

test('a scenario that looks like a page stays text, and a damaged file says so', async () => {
  const address = written('scenarios/first_flight.yaml', 'named', 'name=</script><img src=x>', 'time_limit_s=2');
  const { page, close } = await opened(address);
  assert.equal(await page.locator('h1').innerText(), '</script><img src=x>');
  assert.match(await page.title(), /<\/script><img src=x>/);
  await close();
  const file = join(folder, 'damaged.html');
  const html = readFileSync(new URL(address), 'utf8');
  const at = html.indexOf('id="run">') + 400;
  writeFileSync(file, html.slice(0, at) + 'AAAAAAAA' + html.slice(at + 8));
  const damaged = await openPage(browser, pathToFileURL(file).href);
  await damaged.page.locator('.fault .trouble', { hasText: 'damaged' }).waitFor();
  await damaged.close();
});
