/* SPDX-License-Identifier: Apache-2.0 */
/* microswarm_mex(command, ...): the C interface for MATLAB and Octave. Users call the functions of
 * the package folder +microswarm, which describe their arguments; here arguments are checked and
 * converted. Handles are uint64. Positions are matrices with one row each.
 *
 * Errors have the identifiers microswarm:bad_input, bad_call, stopped, no_memory and fault. */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mex.h"
#include "mex_values.h"
#include "microswarm.h"

/* ---- Open handles --------------------------------------------------------------------------- */

static struct {
  uint64_t* handles;
  size_t count, space;
} opened;

static void close_all(void) {
  size_t i;
  for (i = 0; i < opened.count; ++i) ms_close(opened.handles[i]);
  free(opened.handles);
  memset(&opened, 0, sizeof opened);
}

/* A handle as a MATLAB value; it is closed by `clear mex` at the latest. */
static mxArray* keep(uint64_t handle) {
  mxArray* value;
  if (opened.count == opened.space) {
    const size_t space = 2 * opened.space + 16;
    uint64_t* more = realloc(opened.handles, space * sizeof *more);
    if (!more) {
      ms_close(handle);
      fail("microswarm:no_memory", "there is not enough memory");
    }
    opened.handles = more, opened.space = space;
  }
  opened.handles[opened.count++] = handle;
  value = mxCreateNumericMatrix(1, 1, mxUINT64_CLASS, mxREAL);
  *(uint64_t*)mxGetData(value) = handle;
  return value;
}

static void put(mxArray* made, const char* name, mxArray* value) {
  mxSetFieldByNumber(made, 0, mxAddField(made, name), value);
}

/* Values of a recorded quantity: words as texts in a cell array, of a single value as a text. */
static mxArray* quantity_of(const ms_column* column, const double* values, size_t count,
                            int is_single) {
  const int is_boolean = column->kind == MS_BOOLEAN;
  mxArray* made;
  size_t i;
  if (column->kind == MS_WORD) {
    made = is_single ? NULL : mxCreateCellMatrix(count, 1);
    for (i = 0; i < count; ++i) {
      const int is_there = values[i] >= 0 && values[i] < (double)column->word_count;
      mxArray* word = mxCreateString(is_there ? column->words[(size_t)values[i]] : "");
      if (is_single) return word;
      mxSetCell(made, i, word);
    }
    return made;
  }
  made = is_boolean ? mxCreateLogicalMatrix(count, 1) : mxCreateDoubleMatrix(count, 1, mxREAL);
  for (i = 0; i < count; ++i) {
    if (is_boolean)
      mxGetLogicals(made)[i] = values[i] > 0;
    else
      mxGetPr(made)[i] = values[i];
  }
  return made;
}

/* ---- Commands: arguments in, one value out, null for none ------------------------------------ */

typedef const mxArray* const* arguments;
typedef mxArray* (*command_function)(arguments in);

static mxArray* version(arguments in) {
  (void)in;
  return mxCreateString(ms_version());
}

/* Whether a message is this text; Octave puts the name of the function before it. */
static int is_message(const char* message, const char* text) {
  const size_t length = strlen(message), rest = strlen(text);
  if (rest == 0 || length < rest || strcmp(message + length - rest, text) != 0) return 0;
  return length == rest || message[length - rest - 1] == ' ';
}

/* message of an error: its issues, or the message alone if it is not that of the last error */
static mxArray* issues(arguments in) {
  static const char* names[] = {"key", "place", "text", "value", "limit"};
  const char* message = text_of(in[0], "the message");
  const int is_known = !refused[0] && is_message(message, ms_error_text());
  const size_t count = is_known ? ms_issue_count() : 1;
  mxArray* made = mxCreateStructMatrix(count, 1, 5, names);
  ms_issue issue = {"", "", message, "", ""};
  size_t i;
  for (i = 0; i < count; ++i) {
    if (is_known) ms_issue_at(i, &issue);
    mxSetFieldByNumber(made, i, 0, mxCreateString(issue.key));
    mxSetFieldByNumber(made, i, 1, mxCreateString(issue.place));
    mxSetFieldByNumber(made, i, 2, mxCreateString(issue.text));
    mxSetFieldByNumber(made, i, 3, mxCreateString(issue.value));
    mxSetFieldByNumber(made, i, 4, mxCreateString(issue.limit));
  }
  return made;
}

static mxArray* close_handle(arguments in) {
  const uint64_t handle = handle_of(in[0]);
  size_t i;
  check(ms_close(handle));
  for (i = 0; i < opened.count; ++i)
    if (opened.handles[i] == handle) opened.handles[i--] = opened.handles[--opened.count];
  return NULL;
}

/* file or text, settings, trial */
static mxArray* open_scenario(arguments in, int is_text,
                              int32_t (*open)(const ms_scenario*, uint64_t*)) {
  ms_scenario scenario;
  texts settings;
  uint64_t handle = 0;
  memset(&scenario, 0, sizeof scenario);
  if (is_text)
    scenario.text = text_of(in[0], "the scenario");
  else
    scenario.file = text_of(in[0], "the file");
  settings = settings_of(in[1]);
  scenario.settings = settings.all, scenario.setting_count = settings.count;
  scenario.trial = (uint32_t)whole(in[2], "trial", UINT32_MAX);
  check(open(&scenario, &handle));
  return keep(handle);
}

static mxArray* session_open(arguments in) { return open_scenario(in, 0, ms_session_open_trial); }
static mxArray* session_open_text(arguments in) {
  return open_scenario(in, 1, ms_session_open_trial);
}
static mxArray* navigator_open(arguments in) {
  return open_scenario(in, 0, ms_navigator_open_trial);
}
static mxArray* navigator_open_text(arguments in) {
  return open_scenario(in, 1, ms_navigator_open_trial);
}

/* Steps a limited number of ticks, so that MATLAB can interrupt; whether the run has ended. */
static mxArray* session_advance(arguments in) {
  const uint64_t session = handle_of(in[0]);
  double left = whole(in[1], "the number of ticks", 1e9);
  int32_t code = MS_OK;
  for (; code == MS_OK && left > 0; --left) check(code = ms_session_step(session, NULL));
  return mxCreateLogicalScalar(code == MS_END);
}

static mxArray* session_step(arguments in) {
  const uint64_t session = handle_of(in[0]);
  const ms_column* columns;
  const double* values;
  size_t count, k;
  mxArray* made;
  const int32_t code = ms_session_step(session, NULL);
  check(code);
  if (code == MS_END) return mxCreateDoubleMatrix(0, 0, mxREAL);
  check(ms_frame_columns(&columns, &count));
  check(ms_session_values(session, &values, &count));
  made = mxCreateStructMatrix(1, 1, 0, NULL);
  for (k = 0; k < count; ++k)
    put(made, columns[k].name, quantity_of(columns + k, values + k, 1, 1));
  return made;
}

static mxArray* session_frames(arguments in) {
  const uint64_t session = handle_of(in[0]);
  const ms_column* columns;
  const double* values;
  size_t count, rows, k;
  mxArray* made;
  check(ms_frame_columns(&columns, &count));
  made = mxCreateStructMatrix(1, 1, 0, NULL);
  for (k = 0; k < count; ++k) {
    check(ms_session_column(session, columns[k].name, &values, &rows));
    put(made, columns[k].name, quantity_of(columns + k, values, rows, 0));
  }
  return made;
}

static mxArray* session_set(arguments in) {
  check(ms_session_set(handle_of(in[0]), text_of(in[1], "the key"), text_of(in[2], "the value")));
  return NULL;
}

static mxArray* session_record(arguments in) {
  check(ms_session_record(handle_of(in[0]), text_of(in[1], "the file")));
  return NULL;
}

static mxArray* text_from(arguments in, int32_t (*get)(uint64_t, const char**)) {
  const char* text = NULL;
  check(get(handle_of(in[0]), &text));
  return mxCreateString(text);
}

static mxArray* session_status(arguments in) { return text_from(in, ms_session_status); }
static mxArray* session_metrics(arguments in) { return text_from(in, ms_session_metrics); }
static mxArray* session_hash(arguments in) { return text_from(in, ms_session_hash); }

static mxArray* places_from(arguments in, int32_t (*get)(uint64_t, const double**, size_t*),
                            size_t columns) {
  const double* rows = NULL;
  size_t count = 0;
  check(get(handle_of(in[0]), &rows, &count));
  return matrix_of(rows, count, columns);
}

static mxArray* session_robots(arguments in) { return places_from(in, ms_session_robots, 2); }
static mxArray* session_path(arguments in) { return places_from(in, ms_session_path, 2); }
static mxArray* session_obstacles(arguments in) { return places_from(in, ms_session_obstacles, 3); }
static mxArray* navigator_path(arguments in) { return places_from(in, ms_navigator_path, 2); }

/* Rows x, y, radius, or a cell array of such rows and of outlines, which have two columns. */
static ms_obstacle* obstacles_of(const mxArray* a, size_t* count) {
  const int is_cell = mxIsCell(a);
  double* rows = is_cell ? NULL : rows_of(a, "obstacles", 3, count);
  ms_obstacle* all;
  size_t i;
  if (is_cell) *count = mxGetNumberOfElements(a);
  all = mxCalloc(*count + 1, sizeof *all);
  for (i = 0; i < *count; ++i) {
    const mxArray* one = is_cell ? mxGetCell(a, i) : NULL;
    const double* disc = rows ? rows + 3 * i : NULL;
    if (is_cell && (!one || mxIsEmpty(one))) REFUSE("obstacle %lu is empty", (unsigned long)i + 1);
    if (one && mxGetN(one) == 2) {
      all[i].outline_um = rows_of(one, "an outline", 2, &all[i].points);
      continue;
    }
    if (one && mxGetM(one) != 1)
      REFUSE("obstacle %lu must be a row x, y, radius or an outline of two columns",
             (unsigned long)i + 1);
    if (one) {
      size_t single;
      disc = rows_of(one, "an obstacle", 3, &single);
    }
    all[i].x_um = disc[0], all[i].y_um = disc[1], all[i].radius_um = disc[2];
  }
  return all;
}

static void set_numbers(const mxArray* a, ms_obstacle* obstacles, size_t count) {
  size_t i;
  if (!is_plain_number(a) || mxGetNumberOfElements(a) != count)
    REFUSE("there must be as many numbers as obstacles: %lu", (unsigned long)count);
  for (i = 0; i < count; ++i) {
    const double value = element(a, i);
    if (!(value >= 0 && value <= INT32_MAX && floor(value) == value))
      REFUSE("the number of an obstacle is %g, must be 0 to %ld", value, (long)INT32_MAX);
    obstacles[i].number = (int32_t)value;
  }
}

/* handle, now, seen, swarm, obstacles, numbers, robots, unseen; absent ones are empty. */
static mxArray* navigator_step(arguments in) {
  static const char* const names[] = {"heading_rad", "speed_um_per_s", "state", "target_um",
                                      "planned"};
  const uint64_t navigator = handle_of(in[0]);
  ms_observation seen;
  ms_command command;
  ms_obstacle* obstacles;
  mxArray* made;
  double swarm[4];
  memset(&seen, 0, sizeof seen);
  seen.now_s = number(in[1], "t");
  seen.seen_s = mxIsEmpty(in[2]) ? seen.now_s : number(in[2], "seen");
  if (!mxIsDouble(in[3]) || !mxIsEmpty(in[3])) {
    vector(in[3], "swarm", 4, 4, swarm);
    seen.has_swarm = 1;
    seen.x_um = swarm[0], seen.y_um = swarm[1];
    seen.heading_rad = swarm[2], seen.radius_um = swarm[3];
  }
  obstacles = obstacles_of(in[4], &seen.obstacle_count);
  seen.obstacles = obstacles;
  seen.numbered = !mxIsEmpty(in[5]);
  if (seen.numbered) set_numbers(in[5], obstacles, seen.obstacle_count);
  seen.robots_um = rows_of(in[6], "robots", 2, &seen.robot_count);
  if (!mxIsDouble(in[7]) || !mxIsEmpty(in[7]))
    seen.unseen = (int32_t)whole(in[7], "unseen", INT32_MAX);
  check(ms_navigator_step(navigator, &seen, &command));
  made = mxCreateStructMatrix(1, 1, 5, (const char**)names);
  mxSetFieldByNumber(made, 0, 0, mxCreateDoubleScalar(command.heading_rad));
  mxSetFieldByNumber(made, 0, 1, mxCreateDoubleScalar(command.speed_um_per_s));
  mxSetFieldByNumber(made, 0, 2, mxCreateString(ms_state_name(command.state)));
  mxSetFieldByNumber(made, 0, 3, target_of(command.target_x_um, command.target_y_um));
  mxSetFieldByNumber(made, 0, 4, mxCreateLogicalScalar(command.planned != 0));
  return made;
}

/* A file or a matrix, the side of a pixel, settings of a file; gives the map and notes on it. */
static mxArray* map_open(arguments in) {
  static const char* names[] = {"id", "notes"};
  const double um_per_px = number(in[1], "um_per_px");
  const char* notes = "";
  mxArray* made;
  uint64_t map = 0;
  if (mxIsChar(in[0])) {
    const texts settings = settings_of(in[2]);
    check(ms_map_open_with(text_of(in[0], "the file"), um_per_px, settings.all, settings.count,
                           &map));
  } else {
    size_t row, column, height, width;
    const uint8_t* columns;
    uint8_t* rows;
    if ((!mxIsLogical(in[0]) && !mxIsUint8(in[0])) || mxIsSparse(in[0]) || mxIsComplex(in[0]) ||
        mxGetNumberOfDimensions(in[0]) != 2)
      REFUSE(
          "a map must be the name of a file or a matrix of class logical or uint8, or of other "
          "numbers with a threshold, not %s%s",
          mxIsSparse(in[0]) ? "sparse " : "", mxGetClassName(in[0]));
    height = mxGetM(in[0]), width = mxGetN(in[0]);
    columns = mxGetData(in[0]); /* logical has the same size */
    rows = mxCalloc(width * height + 1, 1);
    for (row = 0; row < height; ++row)
      for (column = 0; column < width; ++column)
        rows[row * width + column] = columns[row + column * height];
    check(ms_map_from_pixels(rows, width, height, um_per_px, &map));
  }
  made = mxCreateStructMatrix(1, 1, 2, names);
  mxSetFieldByNumber(made, 0, 0, keep(map));
  check(ms_map_notes(map, &notes));
  mxSetFieldByNumber(made, 0, 1, mxCreateString(notes));
  return made;
}

static mxArray* map_bounds(arguments in) {
  double box[4];
  check(ms_map_bounds(handle_of(in[0]), box, box + 1, box + 2, box + 3));
  return matrix_of(box, 1, 4);
}

static mxArray* map_clearance(arguments in) {
  const uint64_t map = handle_of(in[0]);
  size_t count, i;
  const double* places = rows_of(in[1], "places", 2, &count);
  mxArray* made = mxCreateDoubleMatrix(count, 1, mxREAL);
  for (i = 0; i < count; ++i)
    check(ms_map_clearance(map, places[2 * i], places[2 * i + 1], mxGetPr(made) + i));
  return made;
}

/* map, start, goal, seed, settings */
static mxArray* plan(arguments in) {
  const uint64_t map = handle_of(in[0]);
  double start[3] = {0, 0, 0}, goal[2];
  ms_query query;
  ms_path path;
  texts settings;
  mxArray* made;
  vector(in[1], "start", 2, 3, start);
  vector(in[2], "goal", 2, 2, goal);
  settings = settings_of(in[4]);
  memset(&query, 0, sizeof query);
  query.start_x_um = start[0], query.start_y_um = start[1], query.start_heading_rad = start[2];
  query.goal_x_um = goal[0], query.goal_y_um = goal[1];
  query.seed = (uint64_t)whole(in[3], "seed", 9007199254740992.0);
  query.settings = settings.all, query.setting_count = settings.count;
  check(ms_plan(map, &query, &path));
  made = mxCreateStructMatrix(1, 1, 0, NULL);
  put(made, "solved", mxCreateLogicalScalar(path.solved != 0));
  put(made, "points_um", matrix_of(path.points_um, path.point_count, 2));
  put(made, "length_um", mxCreateDoubleScalar(path.length_um));
  put(made, "turning_rad", mxCreateDoubleScalar(path.turning_rad));
  put(made, "time_s", mxCreateDoubleScalar(path.time_s));
  put(made, "why_none", mxCreateString(path.why_none));
  return made;
}

#define COMMAND(name, count) \
  { #name, name, count }
static const struct {
  const char* name;
  command_function function;
  int arguments;
} commands[] = {
    COMMAND(version, 0),           COMMAND(issues, 1),
    {"close", close_handle, 1},    COMMAND(session_open, 3),
    COMMAND(session_open_text, 3), COMMAND(session_step, 1),
    COMMAND(session_advance, 2),   COMMAND(session_frames, 1),
    COMMAND(session_set, 3),       COMMAND(session_status, 1),
    COMMAND(session_metrics, 1),   COMMAND(session_hash, 1),
    COMMAND(session_record, 2),    COMMAND(session_robots, 1),
    COMMAND(session_path, 1),      COMMAND(session_obstacles, 1),
    COMMAND(navigator_open, 3),    COMMAND(navigator_open_text, 3),
    COMMAND(navigator_step, 8),    COMMAND(navigator_path, 1),
    COMMAND(map_open, 3),          COMMAND(map_bounds, 1),
    COMMAND(map_clearance, 2),     COMMAND(plan, 5),
};

void mexFunction(int out_count, mxArray* out[], int in_count, const mxArray* in[]) {
  static int is_registered = 0;
  const char* name;
  size_t i;
  if (!is_registered) is_registered = mexAtExit(close_all) == 0;
  if (in_count < 1)
    fail("microswarm:bad_call", "microswarm_mex needs a command; use the functions of +microswarm");
  name = text_of(in[0], "the command");
  for (i = 0; i < sizeof commands / sizeof *commands; ++i) {
    if (strcmp(name, commands[i].name) != 0) continue;
    if (in_count - 1 != commands[i].arguments)
      fail("microswarm:bad_call", "%s takes %d arguments, not %d", name, commands[i].arguments,
           in_count - 1);
    out[0] = commands[i].function(in + 1);
    if (!out[0] && out_count > 0) out[0] = mxCreateDoubleMatrix(0, 0, mxREAL);
    return;
  }
  fail("microswarm:bad_call", "there is no command '%s'", name);
}
