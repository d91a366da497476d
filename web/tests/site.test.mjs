// SPDX-License-Identifier: Apache-2.0
// The static lab (./dev site): the records of WebAssembly are those of the program, to the bit.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openPage, program, root, startBrowser, until } from './lab.mjs';
import { loadModule, serveSite } from './site_lab.mjs';

let browser;
let served;
let folder;

before(async () => {
  [browser, served] = await Promise.all([startBrowser(), serveSite()]);
  folder = mkdtempSync(join(tmpdir(), 'microswarm-site-'));
});
after(async () => {
  await browser.close();
  served.stop();
  rmSync(folder, { recursive: true });
});

/** Runs of tests/golden/records.txt without a rig: { hash, file, settings }. */
const runs = readFileSync(join(root, 'tests/golden/records.txt'), 'utf8')
  .split('\n')
  .filter((line) => /^[0-9a-f]{16}\s+\S+( --set \S+)*$/.test(line))
  .map((line) => {
    const [hash, file] = line.split(/\s+/);
    return { hash, file, settings: [...line.matchAll(/--set (\S+)/g)].map((found) => found[1]) };
  });
const shipped = runs.filter((run) => run.settings.length === 0);

test('every pinned run has its hash in node', async () => {
  const module = await loadModule();
  const others = runs.filter((run) => module.run({ file: run.file, settings: run.settings }) !== run.hash);
  assert.ok(runs.length >= 50);
  assert.deepEqual(others, []);
});

test('every shipped scenario has its hash in the browser', async () => {
  const { page, close } = await openPage(browser, served.url);
  const hashes = await page.evaluate(
    async (files) => {
      const worker = new Worker('worker.js', { type: 'module' });
      const run = (file, id) =>
        new Promise((resolve) => {
          worker.onmessage = ({ data }) => resolve(data.value ?? data.error);
          worker.postMessage({ id, name: 'run', given: [{ file }] });
        });
      const found = [];
      for (const file of files) found.push(await run(file, 1));
      worker.terminate();
      return found;
    },
    shipped.map((run) => run.file),
  );
  assert.ok(shipped.length >= 15);
  assert.deepEqual(
    hashes,
    shipped.map((run) => run.hash),
  );
  await close();
});

/** Opens a scenario of the gallery. */
async function openRun(page, file) {
  await page.click(`[data-file="${file}"]`);
  await until(page, () => window.microswarm?.connection.standing !== undefined);
}

test('a run that was changed is downloaded, and the program repeats it', async () => {
  const { page, picture, close } = await openPage(browser, served.url);
  await openRun(page, 'scenarios/first_flight.yaml');
  await page.evaluate(() => window.microswarm.connection.ask({ do: 'speed', number: 0 }));
  await page.evaluate(() => window.microswarm.connection.ask({ do: 'play', number: 2 }));
  await until(
    page,
    () => window.microswarm.connection.standing.frames > 20 || window.microswarm.connection.history.times.length >= 20,
  );
  const answer = await page.evaluate(() =>
    window.microswarm.connection.ask({ do: 'set', key: 'goal_tolerance_um', value: '60' }),
  );
  assert.deepEqual(answer.issues, []);
  await page.evaluate(() => window.microswarm.connection.ask({ do: 'play', number: 0 }));
  await until(page, () => window.microswarm.connection.standing.ended);
  await page.getByRole('tab', { name: 'Record' }).click();
  await picture('site-record');
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('link', { name: 'record.h5' }).click(),
  ]);
  const file = join(folder, 'record.h5');
  await download.saveAs(file);
  assert.match(execFileSync(program, ['replay', file], { encoding: 'utf8' }), /identical/);
  await close();
});

test('a record of the program plays', async () => {
  const out = join(folder, 'run');
  execFileSync(program, ['run', join(root, 'scenarios/first_flight.yaml'), '--out', out]);
  const { page, close } = await openPage(browser, served.url);
  await page.setInputFiles('input[type=file]', join(out, 'run.h5'));
  await until(page, () => window.microswarm?.connection.standing !== undefined);
  assert.ok(await page.evaluate(() => window.microswarm.connection.hello.playback));
  await close();
});

test('a link holds a scenario of one’s own and the changes', async () => {
  const own = join(folder, 'own.yaml');
  writeFileSync(own, readFileSync(join(root, 'scenarios/first_flight.yaml'), 'utf8').replace('first flight', 'my own'));
  const { page, close } = await openPage(browser, served.url);
  await page.context().grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.setInputFiles('input[type=file]', own);
  await until(page, () => window.microswarm?.connection.standing !== undefined);
  const set = { do: 'set', key: 'goal_tolerance_um', value: '60' };
  await page.evaluate((request) => window.microswarm.connection.ask(request), set);
  await page.getByRole('tab', { name: 'Record' }).click();
  await page.getByRole('button', { name: 'Copy link' }).click();
  await page.getByText('Copied: the scenario').waitFor();
  const address = await page.evaluate(() => navigator.clipboard.readText());
  await close();

  const other = await openPage(browser, address);
  await until(other.page, () => window.microswarm?.connection.standing !== undefined);
  const { name, scenario } = await other.page.evaluate(() => window.microswarm.connection.hello);
  assert.equal(name, 'own/own.yaml');
  assert.equal(scenario.name, 'my own');
  assert.equal(scenario.goal_tolerance_um, 60);
  await other.close();
});

test('a map and a scenario that names it are opened; a photograph is refused in plain words', async () => {
  const { page, close } = await openPage(browser, served.url);
  const give = (name, text) =>
    page.setInputFiles('input[type=file]', { name, mimeType: 'text/plain', buffer: Buffer.from(text) });
  await give('eye.png', 'x');
  await page.getByText('finds no vessels in photographs').waitFor();
  await give('walls.csv', '400,0,40,300\n');
  await page.getByText('walls.csv is kept').waitFor();
  await give(
    'mine.yaml',
    `name: mine
map: {type: rectangles, file: walls.csv, lo_um: [0, 0], hi_um: [1000, 600]}
swarm: {type: vortex, radius_um: 30, moving_radius_um: 30}
start: {x_um: 100, y_um: 100}
goal_um: [900, 100]
`,
  );
  await until(page, () => window.microswarm?.connection.hello?.map.walls.polygons.length === 1);
  await close();
});
