// SPDX-License-Identifier: Apache-2.0
// A lab and a browser for tests. Whatever the page complains of, or asks of another host, fails.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

export const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
export const program = process.env.MICROSWARM ?? join(root, 'build/release/bin/microswarm');
const pictures = join(root, 'build/web');

const labs = new Set(); // that run
process.on('exit', () => labs.forEach((lab) => lab.kill('SIGKILL')));

/** Starts `microswarm lab`: { url, kill(signal) }. */
export async function startLab(...options) {
  const lab = spawn(program, ['lab', '--no-open', ...options], { cwd: root });
  labs.add(lab);
  let said = '';
  lab.stderr.on('data', (text) => (said += text));
  const ended = new Promise((resolve) => lab.on('exit', resolve));
  void ended.then(() => labs.delete(lab));
  const url = await new Promise((resolve, reject) => {
    let text = '';
    lab.stdout.on('data', (more) => {
      text += more;
      if (text.includes('\n')) resolve(text.split('\n')[0]);
    });
    ended.then((code) => reject(new Error(`the lab ended with ${code}: ${said}`)));
  });
  // After a test that failed, none keeps this process from ending.
  for (const one of [lab, lab.stdout, lab.stderr]) one.unref();
  return {
    url,
    process: lab,
    /** Ends it; its exit code. */
    stop: async (signal = 'SIGINT') => {
      lab.ref();
      lab.kill(signal);
      return ended;
    },
  };
}

const options = {
  executablePath: '/usr/bin/chromium',
  args: [
    '--no-sandbox',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader',
  ],
};

export function startBrowser(...more) {
  return chromium.launch({ ...options, args: [...options.args, ...more] });
}

/** A browser whose process can be killed. */
export async function startMortalBrowser() {
  const server = await chromium.launchServer(options);
  const browser = await chromium.connect(server.wsEndpoint());
  return { browser, kill: () => server.process().kill('SIGKILL') };
}

/**
 * A page of the lab; close() fails if there was an error or a request to elsewhere. `first` is called in it before
 * any other script.
 */
export async function openPage(browser, url, size = { width: 1280, height: 800 }, first = undefined) {
  const context = await browser.newContext({ viewport: size, acceptDownloads: true });
  const page = await context.newPage();
  const complaints = [];
  if (first) await page.addInitScript(first);
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.message));
  const host = new URL(url).host;
  page.on('request', (request) => {
    const to = new URL(request.url());
    if (!['blob:', 'data:'].includes(to.protocol) && to.host !== host) complaints.push(`a request to ${to.host}`);
  });
  await page.goto(url);
  return {
    page,
    complaints,
    picture: (name) => {
      mkdirSync(pictures, { recursive: true });
      return page.screenshot({ path: join(pictures, `${name}.png`) });
    },
    /** Closes it; complaints that match `allowed` are none. */
    close: async (allowed = undefined) => {
      await context.close();
      assert.deepEqual(
        complaints.filter((one) => !allowed?.test(one)),
        [],
      );
    },
  };
}

/** Waits until a function of the page gives something; the page's policy forbids page.waitForFunction. */
export async function until(page, holds, { wanted, seconds = 30 } = {}) {
  for (const end = Date.now() + 1000 * seconds; Date.now() < end; await page.waitForTimeout(50))
    if (await page.evaluate(holds, wanted)) return;
  assert.fail(`never: ${holds}`);
}

/** Draws so many robots that move at random, in the scene of the T-junction: pictures a second. */
export function drawRobots(page, count, seconds) {
  return page.evaluate(
    async ([count, seconds]) => {
      const { scene } = window.microswarm;
      scene.show('aggregation', false);
      const robots = new Float32Array(2 * count);
      for (let i = 0; i < robots.length; i += 2) {
        robots[i] = 100 * Math.random();
        robots[i + 1] = 90 + 10 * Math.random();
      }
      const none = new Uint8Array();
      scene.take({ type: 'standing', plays: true, changes: [] });
      const before = scene.pictures;
      const began = performance.now();
      for (let number = 1000; performance.now() < began + 1000 * seconds; ++number) {
        for (let i = 0; i < robots.length; ++i) robots[i] += 0.2 * (Math.random() - 0.5);
        scene.take({
          type: 'frame',
          number,
          frame: { t_s: number / 10, x_um: 0, y_um: 0, radius_um: 0, heading_rad: 0 },
          bodies: { discs: none, polygons: [] },
          robots: new Uint8Array(robots.buffer.slice(0)),
          path: none,
          plans: 0,
        });
        await new Promise((resolve) => requestAnimationFrame(resolve));
      }
      return (scene.pictures - before) / ((performance.now() - began) / 1000);
    },
    [count, seconds],
  );
}

/** Opens a scenario in a lab of its own, with further options, calls `act` with its page and ends both. */
export async function inLab(browser, file, act, ...options) {
  const lab = await startLab(file, ...options);
  const lookedAt = await openPage(browser, lab.url);
  await lookedAt.page.waitForSelector('.form .field', { state: 'attached' });
  await act(lookedAt.page, lookedAt);
  await lookedAt.close();
  assert.equal(await lab.stop(), 0);
}
