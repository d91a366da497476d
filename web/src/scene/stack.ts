// SPDX-License-Identifier: Apache-2.0
import type { Layer } from './layer';
import { Aggregation } from './layers/aggregation';
import { Background } from './layers/background';
import { Camera } from './layers/camera';
import { Clearance } from './layers/clearance';
import { Clock } from './layers/clock';
import { CommonInput } from './layers/common_input';
import { Detections } from './layers/detections';
import { Ghost } from './layers/ghost';
import { Ground } from './layers/ground';
import { Goal, Start } from './layers/marks';
import { ObstacleTrails } from './layers/obstacle_trails';
import { Obstacles } from './layers/obstacles';
import { Path } from './layers/path';
import { Predictions } from './layers/predictions';
import { Radar } from './layers/radar';
import { RobotTrails } from './layers/robot_trails';
import { Robots } from './layers/robots';
import { ScaleBar } from './layers/scale_bar';
import { Swarm } from './layers/swarm';
import { Target } from './layers/target';
import { Team } from './layers/team';
import { Trail } from './layers/trail';
import { Tree } from './layers/tree';
import { Wait } from './layers/wait';
import { Walls } from './layers/walls';

/** All layers of a scene; `came` is called after each picture of a camera. */
export function layerStack(came: () => void) {
  const [background, camera, start, goal] = [new Background(), new Camera(came), new Start(), new Goal()];
  const [obstacles, obstacleTrails, robotTrails] = [new Obstacles(), new ObstacleTrails(), new RobotTrails()];
  const clock = new Clock();
  const listed: Layer[] = [
    background,
    camera,
    new Clearance(),
    new Team(goal),
    new Aggregation(),
    robotTrails,
    new Robots(),
    new Walls([background, camera]), // above the piles of robots, which may be wider than a vessel
    new Tree(),
    new Detections(),
    obstacleTrails,
    obstacles,
    new Predictions(),
    new Trail(),
    new Path(),
    new Target(goal),
    new Wait(goal),
    new Swarm(),
    new Radar(),
    start,
    goal,
    new CommonInput(),
    new ScaleBar(),
    clock,
  ]; // from bottom to top
  return {
    listed,
    ground: new Ground(),
    ghost: new Ghost(),
    background,
    camera,
    start,
    goal,
    clock,
    /** Those that take every frame, also while they are hidden. */
    followers: [obstacles, obstacleTrails, robotTrails],
  };
}
