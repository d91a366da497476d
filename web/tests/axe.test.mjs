// SPDX-License-Identifier: Apache-2.0
// Every page by the rules of axe (WCAG 2.2 A and AA, and its best practices), light and dark, wide and narrow.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import axe from 'axe-core';
import { openPage, program, root, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

/** The violations of a page as it is, in lines. */
async function violations(page) {
  await page.evaluate(axe.source);
  const found = await page.evaluate(async () => {
    const rules = { 'target-size': { enabled: true } };
    const { violations } = await window.axe.run(document, { resultTypes: ['violations'], rules });
    return violations.flatMap(({ id, nodes }) =>
      nodes.slice(0, 5).map(({ target, failureSummary }) => `${id}: ${target.join(' ')}: ${failureSummary}`),
    );
  });
  return found.map((one) => one.replace(/\s+/g, ' '));
}

/** Controls whose edge has a contrast below 3 : 1 with what is around it, which axe does not look at. */
function faintEdges(page) {
  return page.evaluate(() => {
    const rgb = (text) => text.match(/[\d.]+/g).map(Number);
    const light = (colour) => {
      const [r, g, b] = colour
        .map((one) => one / 255)
        .map((one) => (one <= 0.03928 ? one / 12.92 : ((one + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
    const behind = (one) => {
      for (let at = one.parentElement; at; at = at.parentElement) {
        const colour = rgb(getComputedStyle(at).backgroundColor);
        if (colour[3] === undefined || colour[3] === 1) return colour.slice(0, 3);
      }
      return [255, 255, 255];
    };
    const shown = (one) => one.checkVisibility() && !one.disabled && one.getBoundingClientRect().width > 0;
    return [...document.querySelectorAll('input[type=text], input[type=search], select, input.switch')]
      .filter(shown)
      .map((one) => {
        const style = getComputedStyle(one);
        const edge = rgb(one.matches('.switch') ? style.backgroundColor : style.borderTopColor).slice(0, 3);
        return [one.id || one.className, contrast(edge, behind(one))];
      })
      .filter(([, ratio]) => ratio < 3)
      .slice(0, 5)
      .map(([name, ratio]) => `faint edge: ${name}: ${ratio.toFixed(2)}`);
  });
}

const wide = { width: 1280, height: 800 };
const narrow = { width: 390, height: 800 };

/** Fails for a violation in either theme, or at a phone's width. */
async function isClean(page, what, sizes = [wide, narrow]) {
  const found = [];
  for (const [theme, size] of [['dark', wide], ...sizes.map((one) => ['light', one])]) {
    await page.evaluate((theme) => {
      const button = document.querySelector('[aria-label="Light or dark"]');
      if (button && document.documentElement.dataset.theme !== theme) button.click();
    }, theme);
    await page.setViewportSize(size);
    await page.mouse.move(0, 0);
    await page.waitForTimeout(300); // for transitions
    for (const one of [...(await violations(page)), ...(await faintEdges(page))])
      found.push(`${what}, ${theme}, ${size.width} px: ${one}`);
  }
  assert.deepEqual([...new Set(found)], []);
}

/** Each tab of a page. */
async function tabsAreClean(page, what) {
  for (const tab of await page.getByRole('tab').allInnerTexts()) {
    await page.setViewportSize(wide);
    await page.getByRole('tab', { name: tab, exact: true }).click();
    await page.waitForTimeout(300);
    await isClean(page, `${what}, ${tab}`, [wide]);
  }
  await isClean(page, what, [narrow]);
}

async function inLab(act, ...options) {
  const lab = await startLab(...options);
  const { page, close } = await openPage(browser, lab.url);
  await act(page);
  await close();
  assert.equal(await lab.stop(), 0);
}

test('the gallery, with records, mistakes and open runs', () => {
  const folder = mkdtempSync(join(tmpdir(), 'lab-axe-'));
  copyFileSync(join(root, 'tests/samples/walkers.txt'), join(folder, 'wrong.yaml'));
  execFileSync(program, ['run', join(root, 'scenarios/first_flight.yaml'), '--out', folder], { stdio: 'ignore' });
  return inLab(
    async (page) => {
      await page.click('.card[data-file$="first_flight.yaml"]');
      await page.waitForSelector('.session .form .field', { state: 'attached' });
      await page.getByRole('link', { name: '‹ Gallery' }).click();
      await page.waitForSelector('.open-runs');
      await page.waitForTimeout(1000);
      await isClean(page, 'gallery');
      rmSync(folder, { recursive: true });
    },
    '--folder',
    folder,
  );
});

test('a session: its tabs, its keys, a question', () =>
  inLab(async (page) => {
    await page.waitForSelector('.form .field', { state: 'attached' });
    for (let i = 0; i < 4; ++i) await page.keyboard.press('.');
    await page.locator('.group').evaluateAll((all) => all.forEach((one) => (one.open = true)));
    await page.fill('[id="field-goal_tolerance_um"]', '-5');
    await page.keyboard.press('Enter');
    await page.fill('[id="field-seed"]', '7');
    await page.keyboard.press('Enter');
    await page.waitForSelector('.waiting:not([hidden])');
    await tabsAreClean(page, 'session');
    await page.keyboard.press('?');
    await isClean(page, 'keys');
    await page.keyboard.press('Escape');
    await page.setViewportSize(wide);
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    await isClean(page, 'by hand');
    await page.keyboard.press('.');
    await until(page, () => window.microswarm.connection.standing.steered);
    await page.setViewportSize(wide);
    await page.getByRole('link', { name: '‹ Gallery' }).click();
    await page.waitForSelector('dialog.loss');
    await isClean(page, 'question');
    await page.click('.loss .anew');
    await page.waitForSelector('.card');
  }, 'scenarios/first_flight.yaml'));

test('two runs side by side', () =>
  inLab(async (page) => {
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.click('.record .compare');
    await page.waitForSelector('.side[data-side="B"] .scene');
    await page.keyboard.press('.');
    await tabsAreClean(page, 'compare');
  }, 'scenarios/first_flight.yaml'));

test('a record', () => {
  const folder = mkdtempSync(join(tmpdir(), 'lab-axe-'));
  execFileSync(program, ['run', join(root, 'scenarios/first_flight.yaml'), '--out', folder], { stdio: 'ignore' });
  return inLab(
    async (page) => {
      await page.waitForSelector('.form .field', { state: 'attached' });
      await tabsAreClean(page, 'record');
      rmSync(folder, { recursive: true });
    },
    join(folder, 'run.h5'),
  );
});

test('a photograph, step by step', () =>
  inLab(async (page) => {
    await page.waitForSelector('.card');
    await page.setInputFiles('input[type=file]', join(root, 'tests/samples/vessels/retina.png'));
    await page.waitForSelector('.photo-page');
    await isClean(page, 'photograph, scale');
    await page.getByRole('button', { name: 'Next' }).click();
    await page.locator('output', { hasText: 'Vessels cover' }).waitFor({ timeout: 60_000 });
    await isClean(page, 'photograph, vessels');
    await page.getByRole('button', { name: 'Next' }).click();
    await isClean(page, 'photograph, places');
  }));

test('a rig, and the question before it drives', () =>
  inLab(
    async (page) => {
      await page.waitForSelector('.rigbar[data-state="dry"]');
      await page.waitForTimeout(500);
      await tabsAreClean(page, 'rig');
      await page.getByRole('button', { name: 'Arm …' }).click();
      await isClean(page, 'arm');
    },
    'scenarios/first_rig.yaml',
    '--rig',
    'scenarios/rigs/vortex.yaml',
  ));

test('a page that cannot be shown', async () => {
  const lab = await startLab();
  const { page, close } = await openPage(browser, lab.url);
  await page.waitForSelector('.card');
  await page.evaluate(() => (location.hash = '#/session/7'));
  await page.waitForSelector('.fault');
  await isClean(page, 'fault');
  await close(/410/); // that there is no such session
  assert.equal(await lab.stop(), 0);
});
