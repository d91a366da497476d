// SPDX-License-Identifier: Apache-2.0
// The console of a rig: arming, and everything that stops it.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { decode } from 'cborg';
import { openPage, root, startBrowser, startLab, startMortalBrowser, until } from './lab.mjs';

// A busy computer is no fault here.
const patient = ['lost_swarm_s=20', 'max_frame_age_s=20', 'deadman_s=20', 'max_pause_s=20', 'missed_deadlines=1000'];
const rig = [
  'scenarios/first_rig.yaml',
  '--rig',
  'scenarios/rigs/vortex.yaml',
  ...patient.flatMap((one) => ['--set-rig', `safety.${one}`]),
];
let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

/** Opens the console in a lab of its own, calls `act` with its page and ends both. */
async function onRig(act) {
  const lab = await startLab(...rig);
  const lookedAt = await openPage(browser, lab.url);
  await state(lookedAt.page, 'dry');
  await act(lookedAt.page, lookedAt, lab);
  await lookedAt.close();
  assert.ok([0, 4].includes(await lab.stop()), 'as after a rig that was stopped, or not');
}

const state = (page, name) => page.waitForSelector(`.rigbar[data-state="${name}"]`, { timeout: 60_000 });
const why = (page) => page.locator('.rigbar .why').innerText();
/** Arms it. A page that is drawn in software is now and then silent for too long, which stops it. */
async function arm(page) {
  for (let attempt = 0; attempt < 5; ++attempt) {
    await page.getByRole('button', { name: 'Arm …' }).click();
    await page.getByRole('button', { name: 'Arm: drive the coils' }).click();
    await page.waitForSelector('.rigbar[data-state="armed"], .rigbar[data-state="ended"]');
    if (await page.locator('.rigbar[data-state="armed"]').isVisible()) return;
  }
  assert.fail(await why(page));
}
const swarmAt = (page) =>
  page.evaluate(() => {
    const { swarm } = window.microswarm.scene.shownAt(performance.now());
    return [swarm.x, swarm.y];
  });

test('it begins as a dry run with the camera picture and its numbers', () =>
  onRig(async (page, { picture }) => {
    await until(page, () => window.microswarm.scene.layers().some((one) => one.name === 'camera'));
    await page.getByRole('tab', { name: 'Rig' }).click();
    await page.locator('.rig-numbers', { hasText: 'Latencies' }).waitFor();
    assert.match(await why(page), /No current is sent to the coils/);
    await page.waitForTimeout(500);
    await picture('rig-dry');
    const [x] = await swarmAt(page);
    assert.ok(Math.abs(x - 1100) < 5, `the swarm is at ${x}`);
  }));

test('arming asks once more, and Enter does not arm', () =>
  onRig(async (page, { picture }) => {
    await page.getByRole('button', { name: 'Arm …' }).click();
    await page.locator('.arm-panel li').first().waitFor();
    await picture('rig-arm');
    await page.keyboard.press('Enter');
    await page.locator('.arm-panel').waitFor({ state: 'hidden' });
    await state(page, 'dry');
    await arm(page);
    const [before] = await swarmAt(page);
    await until(page, (x) => window.microswarm.scene.shownAt(performance.now()).swarm.x > x + 10, { wanted: before });
    await picture('rig-armed');
    await page.getByTitle('Light or dark').click();
    await picture('rig-armed-dark');
    await page.click('.stop');
    await state(page, 'ended');
    assert.match(await why(page), /stopped it.*Confirmed/);
    await page.locator('.rig-numbers.stale .when', { hasText: 'confirmed by the device' }).waitFor();
    await picture('rig-stopped-dark');
  }));

for (const [name, press] of [
  ['the button', (page) => page.click('.stop')],
  ['space', (page) => page.keyboard.press('Space')],
  ['Esc', (page) => page.keyboard.press('Escape')],
  [
    'space in a field',
    async (page) => {
      await page.getByRole('tab', { name: 'Parameters' }).click();
      await page.locator('.parameters .search').focus();
      await page.keyboard.press('Space');
    },
  ],
  [
    'Esc in the list of keys',
    async (page) => {
      await page.keyboard.press('?');
      await page.waitForSelector('dialog[open]');
      await page.keyboard.press('Escape');
    },
  ],
])
  test(`${name} stops it`, () =>
    onRig(async (page) => {
      await arm(page);
      await press(page);
      await state(page, 'ended');
      assert.match(await why(page), /stopped it/);
    }));

/** A page without a scene, since two that are drawn in software are slow: what it hears of the rig. */
async function plainPage(url) {
  const page = await (await browser.newContext()).newPage();
  await page.goto(url.replace('/?', '/licences.txt?'));
  await page.evaluate(async () => {
    window.heard = [];
    const { sessions } = await (await fetch('/api/sessions')).json();
    window.socket = new WebSocket(`ws://${location.host}/api/stream/${sessions[0].session}`);
    window.socket.binaryType = 'arraybuffer';
    window.socket.onmessage = ({ data }) => {
      // Of the rig's state only; the rest is not worth the time.
      if (data.byteLength > 5000) return;
      const text = new TextDecoder('latin1').decode(data);
      if (text.includes('dtypecrig')) window.heard = [Array.from(new Uint8Array(data))];
    };
    setInterval(() => window.socket.send('{"do": "beat"}'), 50);
  });
  const told = {};
  return {
    say: (request) => page.evaluate((text) => window.socket.send(text), JSON.stringify(request)),
    /** Waits until the rig is in a state; its message. */
    state: async (name) => {
      for (const end = Date.now() + 30_000; Date.now() < end; await page.waitForTimeout(5)) {
        for (const bytes of await page.evaluate(() => window.heard.splice(0))) {
          const message = decode(Uint8Array.from(bytes));
          told[message.type] = message;
        }
        if (told.rig?.state === name) return told.rig;
      }
      return assert.fail(`never ${name}`);
    },
  };
}

for (const [name, end] of [
  ['a tab that is closed', (page) => page.close()],
  ['a browser that is killed', (_, mortal) => mortal.kill()],
])
  test(`${name} stops it`, async () => {
    const lab = await startLab(...rig);
    const mortal = await startMortalBrowser();
    try {
      const page = await (await mortal.browser.newContext()).newPage();
      await page.goto(lab.url);
      await state(page, 'dry');
      const watcher = await plainPage(lab.url);
      await arm(page);
      await watcher.state('armed');
      const began = Date.now();
      await end(page, mortal);
      const { why, zero_confirmed } = await watcher.state('ended');
      console.log(`${name}: zero after ${Date.now() - began} ms`);
      assert.match(why, /is gone|no word/);
      assert.equal(zero_confirmed, true);
    } finally {
      mortal.kill();
      assert.ok([0, 4].includes(await lab.stop()), 'as after a rig that was stopped, or not');
    }
  });

test('a page that watches cannot arm or steer, and can stop', async () => {
  const lab = await startLab(...rig);
  try {
    const opened = await fetch(new URL('/api/sessions', lab.url), {
      method: 'POST',
      body: '{}',
      headers: { cookie: cookieOf(lab.url) },
    });
    assert.ok(opened.ok);
    const holder = await plainPage(lab.url);
    await holder.state('dry');
    const { page, close } = await openPage(browser, lab.url);
    await state(page, 'dry');
    for (const name of ['Arm …', 'Steer', 'Hold']) assert.ok(await page.getByRole('button', { name }).isHidden());
    await holder.say({ id: 1, do: 'arm' });
    await state(page, 'armed');
    assert.match(await why(page), /Another page/);
    await page.keyboard.press('Space');
    assert.equal((await holder.state('ended')).zero_confirmed, true);
    await close();
  } finally {
    assert.ok([0, 4].includes(await lab.stop()), 'as after a rig that was stopped, or not');
  }
});

function cookieOf(url) {
  const { port, searchParams } = new URL(url);
  return `microswarm_${port}=${searchParams.get('token')}`;
}

test('nothing covers the stop button', () =>
  onRig(async (page) => {
    const isOnTop = () =>
      page.evaluate(() => {
        const box = document.querySelector('.stop').getBoundingClientRect();
        return [0.1, 0.5, 0.9].every((share) => {
          const found = document.elementFromPoint(box.left + share * box.width, box.top + box.height / 2);
          return found?.closest('.stop') !== null;
        });
      });
    for (const size of [
      { width: 1280, height: 800 },
      { width: 900, height: 600 },
      { width: 600, height: 700 },
    ]) {
      await page.setViewportSize(size);
      assert.ok(await isOnTop());
      await page.getByRole('button', { name: 'Keys' }).click();
      assert.ok(await isOnTop());
      await page.getByRole('button', { name: 'Close' }).click();
      await page.getByRole('button', { name: 'Arm …' }).click();
      assert.ok(await isOnTop());
      await page.getByRole('button', { name: 'Cancel' }).click();
      await page.evaluate(() => window.scrollTo(0, 2000));
      assert.ok(await isOnTop());
    }
  }));

test('arrow keys steer it by hand', () =>
  onRig(async (page) => {
    await arm(page);
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    const [before] = await swarmAt(page);
    await page.keyboard.down('ArrowLeft');
    await until(page, (x) => window.microswarm.scene.shownAt(performance.now()).swarm.x < x - 8, { wanted: before });
    await page.keyboard.up('ArrowLeft');
    await page.keyboard.press('Escape');
    await state(page, 'ended');
  }));

/** A rig whose coils are driven by a program that writes down what it applies. */
function rigWithDriver(folder) {
  writeFileSync(
    join(folder, 'driver.py'),
    `import sys
sys.path.insert(0, '${join(root, 'examples/drivers')}')
sys.dont_write_bytecode = True
import line_driver
log = open('applied', 'a', buffering=1)
line_driver.serve(lambda values: log.write(' '.join(map(str, values)) + '\\n'))
`,
  );
  writeFileSync(join(folder, 'coils.yaml'), readFileSync(join(root, 'scenarios/rigs/helmholtz.yaml')));
  const file = join(folder, 'rig.yaml');
  writeFileSync(
    file,
    `name: own driver
coils: coils.yaml
field: {kind: rotating, amplitude_mt: 8, frequency_hz: 5, max_pitch_deg: 7.5}
drive_rate_hz: 50
driver: {type: program, command: [python3, driver.py], full_scale_a: 10, reply_timeout_s: 1, watchdog_s: 2}
camera: {type: simulated, microscope: {um_per_px: 6}}
safety: {${patient.map((one) => one.replace('=', ': ')).join(', ')}}
`,
  );
  return file;
}

test('a lab that is killed leaves the coils at zero, and the page says that it is gone', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'microswarm-rig-'));
  const applied = () => readFileSync(join(folder, 'applied'), 'utf8').trim().split('\n');
  const isZero = (line) => line.split(' ').every((one) => Number(one) === 0);
  const lab = await startLab('scenarios/first_rig.yaml', '--rig', rigWithDriver(folder), '--drawn-swarm');
  const { page, picture, close } = await openPage(browser, lab.url);
  await state(page, 'dry');
  await arm(page);
  for (const end = Date.now() + 20_000; isZero(applied().at(-1)) && Date.now() < end;) await page.waitForTimeout(20);
  assert.ok(!isZero(applied().at(-1)), `the coils are driven: ${await why(page)}`);
  const began = Date.now();
  await lab.stop('SIGKILL');
  while (!isZero(applied().at(-1)) && Date.now() < began + 5000) await page.waitForTimeout(5);
  console.log(`killed: zero after ${Date.now() - began} ms`);
  assert.ok(isZero(applied().at(-1)), 'the coils are at zero');
  await state(page, 'lost');
  assert.match(await why(page), /sets the coils to zero/);
  await page.locator('.rig-numbers.stale .when', { hasText: 'Last heard at' }).waitFor();
  for (const one of await page.locator('.rigbar button:visible').all()) assert.ok(await one.isDisabled());
  await picture('rig-lost');
  await close(/net::ERR_/); // that it could not be reached, and nothing else
  rmSync(folder, { recursive: true });
});
