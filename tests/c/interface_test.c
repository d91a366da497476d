/* SPDX-License-Identifier: Apache-2.0 */
/* The C interface from C: what works, and what is refused. */
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "microswarm.h"

static int failures = 0;
#define EXPECT(holds)                                                                 \
  do {                                                                                \
    if (!(holds)) {                                                                   \
      ++failures;                                                                     \
      fprintf(stderr, "line %d: %s; error: %s\n", __LINE__, #holds, ms_error_text()); \
    }                                                                                 \
  } while (0)
#define EXPECT_ERROR(call, code, words)             \
  do {                                              \
    EXPECT((call) == (code));                       \
    EXPECT(strstr(ms_error_text(), words) != NULL); \
  } while (0)

static const char* const scenario =
    "map: {type: polygons, hi_um: [2000, 1000], walls_um: [[[950, 0], [1050, 0], [1050, 450], "
    "[950, 450]]]}\n"
    "swarm: {type: ribbon, radius_um: 40, max_speed_um_per_s: 80}\n"
    "start: {x_um: 200, y_um: 300, heading_deg: 0}\n"
    "goal_um: [1800, 300]\n";

static size_t column_of(const ms_column* columns, size_t count, const char* name) {
  size_t k = 0;
  while (k < count && strcmp(columns[k].name, name) != 0) ++k;
  EXPECT(k < count);
  return k < count ? k : 0;
}

static int is_same(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

/* Every recorded quantity has a column, and its last value is the present one. */
static void columns_are_whole(uint64_t session, size_t frames) {
  const ms_column* columns = NULL;
  const double *values = NULL, *column = NULL;
  double now[200];
  size_t count = 0, rows = 0, k;
  EXPECT(ms_frame_columns(&columns, &count) == MS_OK && count > 15 && count < 200);
  EXPECT(ms_session_values(session, &values, &rows) == MS_OK && rows == count);
  memcpy(now, values, rows * sizeof *now);
  for (k = 0; k < count; ++k) {
    EXPECT(columns[k].name[0] != '\0' && columns[k].meaning[0] != '\0');
    EXPECT((columns[k].kind == MS_WORD) == (columns[k].word_count > 0));
    EXPECT(ms_session_column(session, columns[k].name, &column, &rows) == MS_OK);
    EXPECT(rows == frames && (rows == 0 || is_same(column[rows - 1], now[k])));
  }
}

static void issues(void) {
  const char* settings[] = {"tick_s=0", "navigator.sped_um_per_s=3"};
  const char* none[] = {"tick_s"};
  uint64_t session = 0;
  ms_issue issue;
  EXPECT(ms_session_open_text(scenario, NULL, settings, 2, &session) == MS_BAD_INPUT);
  EXPECT(strstr(ms_error_text(), "--set") == NULL);
  EXPECT(ms_issue_count() == 2);
  EXPECT(ms_issue_at(0, &issue) == MS_OK);
  EXPECT(strcmp(issue.key, "tick_s") == 0 && strcmp(issue.place, "tick_s") == 0);
  EXPECT(strcmp(issue.value, "0") == 0 && strcmp(issue.limit, "0.001..10 s") == 0);
  EXPECT(strstr(issue.text, "tick_s is 0 s") == issue.text);
  EXPECT(ms_issue_at(1, &issue) == MS_OK);
  EXPECT(strcmp(issue.key, "navigator.sped_um_per_s") == 0 && strcmp(issue.value, "3") == 0);
  EXPECT(strstr(issue.limit, "speed_um_per_s") != NULL);
  EXPECT(ms_issue_at(2, &issue) == MS_BAD_CALL && ms_issue_at(0, NULL) == MS_BAD_CALL);
  EXPECT(ms_issue_count() == 2); /* asking changes nothing */
  EXPECT(ms_session_open_text("seed: a\n", NULL, NULL, 0, &session) == MS_BAD_INPUT);
  EXPECT(ms_issue_at(0, &issue) == MS_OK && strcmp(issue.place, "scenario:1:7") == 0);
  EXPECT_ERROR(ms_session_open_text(scenario, NULL, none, 1, &session), MS_BAD_INPUT, "KEY=VALUE");
  EXPECT_ERROR(ms_session_step(0, NULL), MS_BAD_CALL, "closed");
  EXPECT(ms_issue_count() == 1 && ms_issue_at(0, &issue) == MS_OK);
  EXPECT(strcmp(issue.text, ms_error_text()) == 0 && *issue.key == 0 && *issue.limit == 0);
}

static void sessions(const char* file) {
  const char* settings[] = {"time_limit_s=60", "seed=3"};
  uint64_t session = 0, again = 0, playback = 0;
  ms_frame frame;
  const ms_frame* frames = NULL;
  const char* text = NULL;
  char hash[64] = "";
  double length = 0, wall = 0;
  size_t count = 0;
  const double* places = NULL;

  EXPECT(ms_session_open_text(scenario, NULL, settings, 2, &session) == MS_OK);
  EXPECT(session != 0);
  EXPECT(ms_session_status(session, &text) == MS_OK && strcmp(text, "running") == 0);
  EXPECT(ms_session_step(session, &frame) == MS_OK);
  EXPECT(frame.t_s == 0 && frame.x_um == 200 && frame.y_um == 300);
  EXPECT(ms_session_step(session, NULL) == MS_OK);
  EXPECT(ms_session_frames(session, &frames, &count) == MS_OK && count == 2);
  EXPECT(frames[0].x_um == 200 && frames[1].t_s > 0);
  EXPECT_ERROR(ms_session_frames(session, NULL, &count), MS_BAD_CALL, "frames is null");
  EXPECT(ms_session_set(session, "navigator.speed_um_per_s", "60") == MS_OK);
  EXPECT_ERROR(ms_session_set(session, "navigator.sped_um_per_s", "60"), MS_BAD_INPUT,
               "did you mean");
  EXPECT_ERROR(ms_session_set(session, "tick_s", "1"), MS_BAD_INPUT, "cannot be changed");
  EXPECT(ms_session_path(session, &places, &count) == MS_OK && count >= 2 && places != NULL);
  EXPECT(ms_session_robots(session, &places, &count) == MS_OK && count == 0 && places == NULL);
  EXPECT(ms_session_obstacles(session, &places, &count) == MS_OK && count == 0);
  EXPECT(ms_session_finish(session) == MS_OK);
  EXPECT(ms_session_step(session, &frame) == MS_END);
  EXPECT(ms_session_frames(session, &frames, &count) == MS_OK && count > 100);
  EXPECT(strcmp(ms_state_name(frames[count - 1].state), "end") == 0);
  EXPECT(ms_session_status(session, &text) == MS_OK && strcmp(text, "solved") == 0);
  EXPECT(ms_session_metric(session, "length_um", &length) == MS_OK && length > 1600);
  EXPECT(ms_session_metric(session, "walls_clearance_um", &wall) == MS_OK && wall > 40);
  length = wall;
  EXPECT(ms_session_metric(session, "walls.clearance_um", &wall) == MS_OK && wall == length);
  EXPECT(ms_session_metric(session, "obstacles_clearance_um", &wall) == MS_OK && wall > 1e300);
  EXPECT(ms_session_metric(session, "turning_rad", &length) == MS_OK && length > 0.1);
  EXPECT(ms_session_metric(session, "turning_deg", &wall) == MS_OK);
  EXPECT(fabs(wall * 3.14159265358979 / 180 - length) < 1e-6 * length);
  EXPECT_ERROR(ms_session_metric(session, "walls", &wall), MS_BAD_INPUT, "no metric 'walls'");
  EXPECT_ERROR(ms_session_metric(session, "walls.speed", &wall), MS_BAD_INPUT, "no metric");
  EXPECT_ERROR(ms_session_metric(session, "lenth_um", &wall), MS_BAD_INPUT,
               "did you mean 'length_um'");
  EXPECT(ms_session_metrics(session, &text) == MS_OK && strstr(text, "\"length_um\"") != NULL);
  EXPECT(ms_session_hash(session, &text) == MS_OK);
  strncpy(hash, text, sizeof hash - 1);
  EXPECT(ms_session_record(session, file) == MS_OK);

  EXPECT(ms_session_open(file, NULL, 0, &playback) == MS_OK);
  EXPECT(ms_session_frames(playback, &frames, &count) == MS_OK && count > 100);
  EXPECT(ms_session_finish(playback) == MS_OK);
  columns_are_whole(playback, count);
  EXPECT(ms_session_hash(playback, &text) == MS_OK && strcmp(text, hash) == 0);
  EXPECT(ms_session_open_text(scenario, "", settings, 2, &again) == MS_OK && again != session);
  EXPECT(ms_close(playback) == MS_OK && ms_close(session) == MS_OK && ms_close(again) == MS_OK);
  EXPECT_ERROR(ms_session_step(session, &frame), MS_BAD_CALL, "closed");
  EXPECT_ERROR(ms_close(session), MS_BAD_CALL, "closed");
}

static void columns(void) {
  uint64_t session = 0;
  const ms_column* columns = NULL;
  const ms_frame* frames = NULL;
  const double* values = NULL;
  size_t count = 0, rows = 0, of_state, i;
  EXPECT(ms_session_open_text(scenario, NULL, NULL, 0, &session) == MS_OK);
  EXPECT(ms_frame_columns(&columns, &count) == MS_OK);
  columns_are_whole(session, 0);
  EXPECT(ms_session_values(session, &values, &rows) == MS_OK);
  EXPECT(values[column_of(columns, count, "x_um")] == 200);
  for (i = 0; i < 3; ++i) EXPECT(ms_session_step(session, NULL) == MS_OK);
  columns_are_whole(session, 3);
  EXPECT(ms_session_finish(session) == MS_OK);
  EXPECT(ms_session_frames(session, &frames, &rows) == MS_OK);
  columns_are_whole(session, rows);
  EXPECT(ms_session_frames(session, &frames, &rows) == MS_OK);
  EXPECT(ms_session_column(session, "target_x_um", &values, &count) == MS_OK && count == rows);
  for (i = 0; i < rows; ++i) EXPECT(is_same(values[i], frames[i].target_x_um));
  EXPECT(ms_session_column(session, "planned", &values, &count) == MS_OK && values[0] == 1);
  EXPECT(ms_frame_columns(&columns, &count) == MS_OK);
  of_state = column_of(columns, count, "state");
  EXPECT(columns[column_of(columns, count, "planned")].kind == MS_BOOLEAN);
  EXPECT(strcmp(columns[column_of(columns, count, "speed_um_per_s")].unit, "µm/s") == 0);
  EXPECT(ms_session_column(session, "state", &values, &rows) == MS_OK);
  for (i = 0; i < rows; ++i)
    EXPECT(strcmp(columns[of_state].words[(size_t)values[i]], ms_state_name(frames[i].state)) == 0);
  EXPECT_ERROR(ms_session_column(session, "goal_distanse_um", &values, &rows), MS_BAD_INPUT,
               "did you mean 'goal_distance_um'");
  EXPECT_ERROR(ms_session_column(session, "", &values, &rows), MS_BAD_INPUT, "no recorded");
  EXPECT_ERROR(ms_session_column(session, NULL, &values, &rows), MS_BAD_CALL, "name is null");
  EXPECT_ERROR(ms_session_values(session, NULL, &rows), MS_BAD_CALL, "values is null");
  EXPECT_ERROR(ms_frame_columns(&columns, NULL), MS_BAD_CALL, "count is null");
  EXPECT(ms_close(session) == MS_OK);
  EXPECT_ERROR(ms_session_column(session, "x_um", &values, &rows), MS_BAD_CALL, "closed");
}

static void bad_sessions(void) {
  const char* settings[] = {"goal_um=[1, 2", NULL};
  uint64_t session = 7;
  EXPECT_ERROR(ms_session_open("no/such.yaml", NULL, 0, &session), MS_BAD_INPUT, "no/such.yaml");
  EXPECT_ERROR(ms_session_open(NULL, NULL, 0, &session), MS_BAD_CALL, "file is null");
  EXPECT_ERROR(ms_session_open_text(scenario, NULL, NULL, 1, &session), MS_BAD_CALL, "settings");
  EXPECT_ERROR(ms_session_open_text(scenario, NULL, settings, 1, &session), MS_BAD_INPUT,
               "goal_um");
  EXPECT_ERROR(ms_session_open_text(scenario, NULL, settings, 2, &session), MS_BAD_CALL, "null");
  EXPECT_ERROR(ms_session_open_text("goal_um: 3", NULL, NULL, 0, &session), MS_BAD_INPUT,
               "scenario:1:10");
  EXPECT_ERROR(ms_session_open_text(scenario, NULL, NULL, 0, NULL), MS_BAD_CALL, "session is null");
  EXPECT(session == 7);
  EXPECT_ERROR(ms_session_step(0, NULL), MS_BAD_CALL, "never");
}

/* Trials differ by their random streams; trial 0 is what the plain functions open. */
static void trials(const char* record) {
  const char* settings[] = {"time_limit_s=5", "swarm.position_noise_um=5"};
  ms_scenario given;
  char hashes[3][64] = {"", "", ""};
  uint64_t session = 0, navigator = 0;
  const char* hash = NULL;
  uint32_t k;
  memset(&given, 0, sizeof given);
  EXPECT_ERROR(ms_session_open_trial(&given, &session), MS_BAD_CALL, "file or text");
  EXPECT_ERROR(ms_session_open_trial(NULL, &session), MS_BAD_CALL, "scenario is null");
  given.text = scenario, given.settings = settings, given.setting_count = 2;
  EXPECT_ERROR(ms_session_open_trial(&given, NULL), MS_BAD_CALL, "session is null");
  for (k = 0; k < 3; ++k) {
    given.trial = k;
    EXPECT(ms_session_open_trial(&given, &session) == MS_OK);
    EXPECT(ms_session_finish(session) == MS_OK && ms_session_hash(session, &hash) == MS_OK);
    strncpy(hashes[k], hash, 63);
    EXPECT(ms_close(session) == MS_OK);
    EXPECT(ms_navigator_open_trial(&given, &navigator) == MS_OK && ms_close(navigator) == MS_OK);
  }
  EXPECT(strcmp(hashes[0], hashes[1]) != 0 && strcmp(hashes[1], hashes[2]) != 0);
  EXPECT(ms_session_open_text(scenario, NULL, settings, 2, &session) == MS_OK);
  EXPECT(ms_session_finish(session) == MS_OK && ms_session_hash(session, &hash) == MS_OK);
  EXPECT(strcmp(hash, hashes[0]) == 0 && ms_close(session) == MS_OK);
  given.file = record;
  EXPECT_ERROR(ms_session_open_trial(&given, &session), MS_BAD_CALL, "file or text");
  given.text = NULL;
  EXPECT_ERROR(ms_session_open_trial(&given, &session), MS_BAD_INPUT, "accepts no options");
  given.setting_count = 0, given.trial = 0;
  EXPECT(ms_session_open_trial(&given, &session) == MS_OK && ms_close(session) == MS_OK);
}

static void navigators(void) {
  uint64_t navigator = 0;
  ms_obstacle obstacle = {600, 300, 60, NULL, 0, 0};
  const double outline[] = {900, 600, 950, 600, 950, 650};
  ms_observation seen;
  ms_command command;
  const double* path = NULL;
  size_t count = 0;
  int k;
  memset(&seen, 0, sizeof seen);
  seen.has_swarm = 1, seen.x_um = 200, seen.y_um = 300, seen.radius_um = 40;
  seen.obstacles = &obstacle, seen.obstacle_count = 1;
  EXPECT(ms_navigator_open_text(scenario, NULL, NULL, 0, &navigator) == MS_OK);
  for (k = 0; k < 20; ++k) {
    seen.now_s = 0.1 * k, seen.seen_s = seen.now_s;
    EXPECT(ms_navigator_step(navigator, &seen, &command) == MS_OK);
    seen.x_um += 0.1 * command.speed_um_per_s * cos(command.heading_rad);
    seen.y_um += 0.1 * command.speed_um_per_s * sin(command.heading_rad);
  }
  EXPECT(seen.x_um > 250);
  EXPECT(strcmp(ms_state_name(command.state), "follow") == 0);
  EXPECT(strcmp(ms_state_name(-1), "") == 0 && strcmp(ms_state_name(1000), "") == 0);
  EXPECT(ms_navigator_path(navigator, &path, &count) == MS_OK && count >= 2);
  seen.unseen = 1;
  EXPECT_ERROR(ms_navigator_step(navigator, &seen, &command), MS_BAD_INPUT, "no robots");
  seen.unseen = 0, seen.numbered = 1, obstacle.number = -1;
  EXPECT_ERROR(ms_navigator_step(navigator, &seen, &command), MS_BAD_INPUT, "is -1");
  seen.numbered = 0;
  obstacle.outline_um = outline, obstacle.points = 3;
  EXPECT(ms_navigator_step(navigator, &seen, &command) == MS_OK);
  obstacle.points = 2;
  EXPECT_ERROR(ms_navigator_step(navigator, &seen, &command), MS_BAD_INPUT, "fewer than 3");
  seen.obstacle_count = 0, seen.y_um = NAN;
  EXPECT_ERROR(ms_navigator_step(navigator, &seen, &command), MS_BAD_INPUT, "nan");
  seen.y_um = 300, seen.now_s = 0;
  EXPECT_ERROR(ms_navigator_step(navigator, &seen, &command), MS_BAD_INPUT, "before");
  EXPECT_ERROR(ms_navigator_step(navigator, NULL, &command), MS_BAD_CALL, "seen is null");
  EXPECT_ERROR(ms_session_finish(navigator), MS_BAD_CALL, "not that of a session");
  EXPECT(ms_close(navigator) == MS_OK);
}

static void paths(void) {
  uint8_t pixels[40 * 40];
  const char* settings[] = {"planner.type=drrt_star", "planner.clearance_um=15"};
  const char* typo[] = {"planner.clearence_um=15"};
  const char* walls[] = {"map.wall=one"};
  const char* notes = NULL;
  FILE* file;
  uint64_t map = 0;
  ms_query query;
  const char* values[] = {"map.threshold=90", "map.free=dark", "map.threshold=256", "map.wall=one"};
  ms_path path;
  double lo = -1, hi = -1, y = 0, free = 0;
  int row, column;
  for (row = 0; row < 40; ++row)
    for (column = 0; column < 40; ++column)
      pixels[40 * row + column] = !(column >= 18 && column < 22 && row >= 10);
  EXPECT(ms_map_from_pixels(pixels, 40, 40, 10, &map) == MS_OK);
  EXPECT(ms_map_bounds(map, &lo, &y, &hi, &y) == MS_OK && lo == 0 && hi == 400 && y == 400);
  EXPECT(ms_map_clearance(map, 50, 50, &free) == MS_OK && free == 50);
  EXPECT(ms_map_clearance(map, 200, 50, &free) == MS_OK && free == 0);
  memset(&query, 0, sizeof query);
  query.start_x_um = 50, query.start_y_um = 50, query.goal_x_um = 350, query.goal_y_um = 50;
  query.seed = 1, query.settings = settings, query.setting_count = 2;
  EXPECT(ms_plan(map, &query, &path) == MS_OK);
  EXPECT(path.solved && path.point_count >= 3 && path.length_um > 600 && path.why_none[0] == '\0');
  EXPECT(path.points_um[0] == 50 && path.points_um[1] == 50);
  query.settings = typo, query.setting_count = 1;
  EXPECT_ERROR(ms_plan(map, &query, &path), MS_BAD_INPUT, "did you mean");
  query.setting_count = 0, query.start_heading_rad = NAN;
  EXPECT_ERROR(ms_plan(map, &query, &path), MS_BAD_INPUT, "finite");
  query.start_heading_rad = 0, query.goal_x_um = 200;
  EXPECT_ERROR(ms_plan(map, &query, &path), MS_BAD_INPUT, "goal is 20 µm inside wall");
  EXPECT(ms_map_notes(map, &notes) == MS_OK && notes[0] == '\0');
  query.goal_x_um = 225, query.settings = settings, query.setting_count = 2;
  EXPECT(ms_plan(map, &query, &path) == MS_OK && path.solved);
  EXPECT(ms_map_notes(map, &notes) == MS_OK && strstr(notes, "goal is 5 µm from wall"));
  EXPECT(ms_close(map) == MS_OK);
  for (row = 0; row < 40 * 40; ++row) pixels[row] = pixels[row] ? 128 : 127; /* grey */
  EXPECT(ms_map_from_pixels(pixels, 40, 40, 10, &map) == MS_OK);
  EXPECT(ms_map_clearance(map, 50, 50, &free) == MS_OK && free == 50);
  EXPECT(ms_map_clearance(map, 200, 50, &free) == MS_OK && free == 0);
  EXPECT(ms_close(map) == MS_OK);
  memset(pixels, 2, sizeof pixels);
  EXPECT_ERROR(ms_map_from_pixels(pixels, 40, 40, 10, &map), MS_BAD_INPUT,
               "its largest value is 2");
  for (row = 0; row < 40 * 40; ++row) pixels[row] = row % 40 < 20 ? 90 : 89;
  EXPECT(ms_map_from_pixels_with(pixels, 40, 40, 10, values, 1, &map) == MS_OK);
  EXPECT(ms_map_clearance(map, 195, 200, &free) == MS_OK && free == 5);
  EXPECT(ms_map_clearance(map, 205, 200, &free) == MS_OK && free == 0);
  EXPECT(ms_close(map) == MS_OK);
  EXPECT(ms_map_from_pixels_with(pixels, 40, 40, 10, values, 2, &map) == MS_OK);
  EXPECT(ms_map_clearance(map, 195, 200, &free) == MS_OK && free == 0);
  EXPECT(ms_map_clearance(map, 205, 200, &free) == MS_OK && free == 5);
  EXPECT(ms_close(map) == MS_OK);
  EXPECT_ERROR(ms_map_from_pixels_with(pixels, 40, 40, 10, values + 2, 1, &map), MS_BAD_INPUT,
               "threshold is 256, allowed 0..255");
  EXPECT_ERROR(ms_map_from_pixels_with(pixels, 40, 40, 10, values + 3, 1, &map), MS_BAD_INPUT,
               "unknown key 'wall'");
  EXPECT_ERROR(ms_map_from_pixels_with(pixels, 40, 40, 10, NULL, 1, &map), MS_BAD_CALL, "settings");
  memset(pixels, 1, sizeof pixels);
  EXPECT(ms_map_from_pixels(pixels, 40, 40, 10, &map) == MS_OK);
  EXPECT(ms_map_notes(map, &notes) == MS_OK && strstr(notes, "no walls"));
  EXPECT(ms_close(map) == MS_OK);
  EXPECT_ERROR(ms_map_from_pixels(pixels, 0, 40, 10, &map), MS_BAD_INPUT, "must be 1 to");
  EXPECT_ERROR(ms_map_from_pixels(pixels, 40, 40, NAN, &map), MS_BAD_INPUT, "um_per_px");
  EXPECT_ERROR(ms_map_open("no.png", 1, &map), MS_BAD_INPUT, "no.png");
  file = fopen("interface_test_matrix.txt", "w");
  EXPECT(file && fputs("1 1 1\n1 0 1\n1 1 1\n", file) >= 0 && fclose(file) == 0);
  EXPECT(ms_map_open("interface_test_matrix.txt", 10, &map) == MS_OK);
  EXPECT(ms_map_clearance(map, 5, 5, &free) == MS_OK && free == 5);
  EXPECT(ms_map_notes(map, &notes) == MS_OK && strstr(notes, "map.wall=one"));
  EXPECT(ms_close(map) == MS_OK);
  EXPECT(ms_map_open_with("interface_test_matrix.txt", 10, walls, 1, &map) == MS_OK);
  EXPECT(ms_map_clearance(map, 5, 5, &free) == MS_OK && free == 0);
  EXPECT(ms_map_clearance(map, 15, 15, &free) == MS_OK && free == 5);
  EXPECT(ms_map_notes(map, &notes) == MS_OK && notes[0] == '\0');
  EXPECT(ms_close(map) == MS_OK);
  remove("interface_test_matrix.txt");
}

/* What docs/how-to/use-from-matlab.md tells users of LabVIEW about structures. */
static void layout(void) {
  if (sizeof(void*) != 8) return;
  EXPECT(sizeof(ms_observation) == 96 && offsetof(ms_observation, x_um) == 24);
  EXPECT(offsetof(ms_observation, obstacles) == 56 && offsetof(ms_observation, robots_um) == 72);
  EXPECT(offsetof(ms_observation, unseen) == 88);
  EXPECT(sizeof(ms_obstacle) == 48 && offsetof(ms_obstacle, number) == 40);
  EXPECT(sizeof(ms_command) == 40 && offsetof(ms_command, state) == 32);
}

static void* run_one(void* result) {
  uint64_t session = 0;
  const char* hash = NULL;
  if (ms_session_open_text(scenario, NULL, NULL, 0, &session) == MS_OK &&
      ms_session_finish(session) == MS_OK && ms_session_hash(session, &hash) == MS_OK)
    strncpy(result, hash, 63);
  ms_close(session);
  return NULL;
}

static void* finish_one(void* handle) {
  const uint64_t session = *(const uint64_t*)handle;
  const int32_t code = ms_session_finish(session);
  return code == MS_STOPPED ? handle : NULL;
}

static void threads(void) {
  pthread_t first, second;
  char a[64] = "", b[64] = "";
  uint64_t session = 0;
  void* was_stopped = NULL;
  const char* endless[] = {"hold_limit_s=1e5", "time_limit_s=1e5", "goal_um=[1800, 990]"};
  EXPECT(pthread_create(&first, NULL, run_one, a) == 0);
  EXPECT(pthread_create(&second, NULL, run_one, b) == 0);
  pthread_join(first, NULL);
  pthread_join(second, NULL);
  EXPECT(a[0] != '\0' && strcmp(a, b) == 0);

  EXPECT(ms_session_open_text(scenario, NULL, endless, 2, &session) == MS_OK);
  EXPECT(ms_stop(session) == MS_OK);
  EXPECT(pthread_create(&first, NULL, finish_one, &session) == 0);
  pthread_join(first, &was_stopped);
  EXPECT(was_stopped != NULL);
  EXPECT(ms_close(session) == MS_OK);
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  EXPECT(ms_interface() >= MS_INTERFACE);
  EXPECT(strchr(ms_version(), '.') != NULL);
  EXPECT(ms_error_text()[0] == '\0');
  issues();
  sessions(arguments[1]);
  columns();
  bad_sessions();
  trials(arguments[1]);
  navigators();
  paths();
  layout();
  threads();
  if (failures == 0) puts("all as expected");
  return failures == 0 ? 0 : 1;
}
