# SPDX-License-Identifier: Apache-2.0
"""Two agents in NumPy learn to steer a swarm past a wall and moving discs, and are compared with rules that do not learn.

    python3 examples/learn_to_navigate.py [--quick] [--steps N] [--seed N] [--svg FILE]

Both train a network of two layers: PPO goes over the steps of each update several times (Schulman et al., "Proximal Policy
Optimization Algorithms", 2017), the plain policy gradient with a critic goes once. Start and goal are drawn at random for each
episode.
"""

import argparse
import os
import pathlib
import time
from typing import Any, Callable

import numpy as np

import microswarm as ms
from microswarm import environments

FOLDER = os.environ.get("MICROSWARM_SCENARIOS", "scenarios")
ENVS = 128  # stepped together
HORIZON = 16  # steps of each between two updates
GAMMA, LAMBDA = 0.97, 0.95
TEST_SEED = 10**6  # episodes that no agent is trained with

Act = Callable[[np.ndarray], np.ndarray]


def task(count: int, mode: str = "SameStep") -> environments.NavigationVectorEnv:
    """The room of first_flight, seen and steered twice a second."""
    scenario = ms.Scenario.load(f"{FOLDER}/first_flight.yaml").set("tick_s", 0.5)
    return environments.make_vec(
        "microswarm/Navigation-v0", count, scenario=scenario, autoreset_mode=mode, random_start=True, random_goal=True, rays=16, obstacles=2
    )


def success_rate(act: Act, episodes: int, seed: int = TEST_SEED) -> float:
    """Share of episodes in which `act(observations)` reaches the goal, one episode in each environment."""
    envs = task(episodes, "NextStep")
    seen, _ = envs.reset(seed=seed)
    running, success = np.ones(episodes, bool), np.zeros(episodes, bool)
    while running.any():
        seen, _, terminated, truncated, infos = envs.step(np.clip(act(seen), -1, 1))
        ended = running & (terminated | truncated)
        if ended.any():
            success[ended] = infos["success"][ended]
        running &= ~ended
    return float(success.mean())


class Network:
    """Two hidden layers of tanh with a linear output, and Adam."""

    def __init__(self, sizes: list[int], last: float, random: np.random.Generator) -> None:
        self.values: list[np.ndarray] = []  # weights and offsets in turn
        for i, (a, b) in enumerate(zip(sizes, sizes[1:])):
            scale = last if i == len(sizes) - 2 else 1
            self.values += [random.normal(0, scale / np.sqrt(a), (a, b)), np.zeros(b)]
        self.moments = [[np.zeros_like(one), np.zeros_like(one)] for one in self.values]
        self.updates = 0

    def __call__(self, x: np.ndarray) -> np.ndarray:
        self.layers = [x]
        for i in range(0, len(self.values), 2):
            x = x @ self.values[i] + self.values[i + 1]
            if i < len(self.values) - 2:
                x = np.tanh(x)
            self.layers.append(x)
        return x

    def learn(self, slope: np.ndarray, rate: float) -> None:
        """One step down the slope of a loss by the output of the last call."""
        self.updates += 1
        for i in range(len(self.values) - 2, -1, -2):
            below = self.layers[i // 2]
            slopes = (below.T @ slope, slope.sum(0))
            slope = (slope @ self.values[i].T) * (1 - below**2)
            for k, one in enumerate(slopes):
                first, second = self.moments[i + k]
                first += 0.1 * (one - first)
                second += 0.001 * (one**2 - second)
                scaled = first / (1 - 0.9**self.updates) / (np.sqrt(second / (1 - 0.999**self.updates)) + 1e-8)
                self.values[i + k] -= rate * scaled


def advantages(rewards: np.ndarray, values: np.ndarray, ended: np.ndarray, last: np.ndarray) -> np.ndarray:
    """Generalised advantage estimates; an ended episode has no value after it."""
    made, running = np.zeros_like(rewards), np.zeros_like(last)
    following = last
    for t in range(len(rewards) - 1, -1, -1):
        goes_on = ~ended[t]
        running = rewards[t] + GAMMA * following * goes_on - values[t] + GAMMA * LAMBDA * goes_on * running
        made[t], following = running, values[t]
    return made


def train(steps: int, seed: int, passes: int, report: Callable[[int, int, int], None]) -> Act:
    """Trains a policy; calls `report(steps, successes, episodes)` with each update."""
    random = np.random.default_rng(seed)
    envs = task(ENVS)
    seen, _ = envs.reset(seed=seed)
    size = seen.shape[1]
    policy, critic = Network([size, 64, 64, 2], 0.01, random), Network([size, 64, 64, 1], 1, random)
    updates = max(1, steps // (ENVS * HORIZON))
    for update in range(updates):
        spread = np.exp(-0.5 - 1.2 * update / updates)  # of the actions that are tried
        rate = 2e-3 * (1 - 0.9 * update / updates)
        batch: dict[str, Any] = {key: [] for key in ("seen", "action", "reward", "ended", "value")}
        successes = episodes = 0
        for _ in range(HORIZON):
            action = policy(seen) + spread * random.normal(size=(ENVS, 2))
            value = critic(seen)[:, 0]
            following, reward, terminated, truncated, infos = envs.step(np.clip(action, -1, 1))
            if "final_info" in infos:
                successes += infos["final_info"]["success"].sum()
                episodes += infos["_final_info"].sum()
            for key, one in zip(batch, (seen, action, reward, terminated | truncated, value)):
                batch[key].append(one)
            seen = following
        report((update + 1) * ENVS * HORIZON, successes, episodes)
        batch = {key: np.array(one) for key, one in batch.items()}
        gain = advantages(batch["reward"], batch["value"], batch["ended"], critic(seen)[:, 0])
        target = (gain + batch["value"]).ravel()
        gain = ((gain - gain.mean()) / (gain.std() + 1e-8)).ravel()
        seen_all, action_all = (batch[key].reshape(-1, batch[key].shape[2]) for key in ("seen", "action"))
        old = -((action_all - policy(seen_all)) ** 2).sum(1) / (2 * spread**2)
        for _ in range(passes):
            for rows in np.array_split(random.permutation(len(gain)), 4):
                away = action_all[rows] - policy(seen_all[rows])
                ratio = np.exp(np.clip(-(away**2).sum(1) / (2 * spread**2) - old[rows], -20, 20))
                held = np.where(gain[rows] > 0, ratio < 1.2, ratio > 0.8)
                policy.learn(-(held * ratio * gain[rows] / len(rows))[:, None] * away / spread**2, rate)
                critic.learn((critic(seen_all[rows]) - target[rows, None]) / len(rows), rate)
    return policy


def draw(file: str, curves: dict[str, list[tuple[int, float]]], lines: dict[str, float]) -> None:
    """Draws success rates over steps as curves, and those of rules that do not learn as lines."""
    width, height, left, top = 560, 300, 56, 16
    right, bottom = 150, 44
    most = max(x for points in curves.values() for x, _ in points)

    def at_x(x: float) -> float:
        return left + (width - left - right) * x / most

    def at_y(y: float) -> float:
        return height - bottom - (height - top - bottom) * y

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">']
    parts.append(f'<rect width="{width}" height="{height}" fill="white"/>')
    for share in (0, 0.25, 0.5, 0.75, 1):
        parts.append(f'<path d="M{left} {at_y(share):.1f}H{width - right}" stroke="#ddd"/><text x="{left - 6}" y="{at_y(share) + 4:.1f}" text-anchor="end">{share:.0%}</text>')
    for x in range(0, most + 1, 50_000 if most > 100_000 else 5_000):
        parts.append(f'<text x="{at_x(x):.1f}" y="{height - bottom + 16}" text-anchor="middle">{x / 1000:.0f}</text>')
    parts.append(f'<text x="{at_x(most / 2):.1f}" y="{height - 8}" text-anchor="middle">steps of the environment, thousands</text>')
    parts.append(f'<text transform="translate(13 {at_y(0.5):.1f}) rotate(-90)" text-anchor="middle">episodes that reach the goal</text>')
    ends = []
    for (name, points), colour in zip(curves.items(), ("#0072b2", "#d55e00")):
        path = " ".join(f"{at_x(x):.1f},{at_y(y):.1f}" for x, y in points)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        ends.append((points[-1][1], name, colour))
    for (name, share), colour in zip(lines.items(), ("#555", "#999")):
        parts.append(f'<path d="M{left} {at_y(share):.1f}H{width - right}" stroke="{colour}" stroke-dasharray="5 4"/>')
        ends.append((share, name, colour))
    above = -100.0
    for share, name, colour in sorted(ends, reverse=True):
        above = max(above + 15, at_y(share) + 4)  # no label covers another
        parts.append(f'<text x="{width - right + 6}" y="{above:.1f}" fill="{colour}">{name}</text>')
    pathlib.Path(file).write_text("\n".join(parts) + "\n</svg>\n", encoding="utf-8")


def straight(seen: np.ndarray) -> np.ndarray:
    """At full speed in the direction of the goal."""
    return seen[:, :2] / np.maximum(np.hypot(seen[:, 0], seen[:, 1]), 1e-9)[:, None]


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--quick", action="store_true", help="a tenth of the steps")
    options.add_argument("--steps", type=int, default=300_000, help="steps of the environment for each agent")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--svg", help="write the curves into this file")
    given = options.parse_args()
    steps, episodes = (given.steps // 10, 100) if given.quick else (given.steps, 500)
    random = np.random.default_rng(given.seed)
    rates = {"at random": success_rate(lambda seen: random.uniform(-1, 1, (len(seen), 2)), episodes), "straight": success_rate(straight, episodes)}
    curves: dict[str, list[tuple[int, float]]] = {}
    for name, passes in (("PPO", 4), ("policy gradient", 1)):
        began, window = time.process_time(), []
        curves[name] = [(0, rates["at random"])]

        def report(done: int, successes: int, ended: int) -> None:
            window.append((successes, ended))
            of_last = np.sum(window[-8:], axis=0)
            curves[name].append((done, of_last[0] / max(of_last[1], 1)))

        act = train(steps, given.seed, passes, report)
        rates[name] = success_rate(act, episodes)
        print(f"{name} learned from {curves[name][-1][0]:,} steps in {time.process_time() - began:.0f} s of computing", flush=True)
    for name, rate in rates.items():
        print(f"{name:15s} reaches the goal in {rate:4.0%} of {episodes} episodes")
    if given.svg:
        draw(given.svg, curves, {name: rates[name] for name in ("straight", "at random")})


if __name__ == "__main__":
    main()
