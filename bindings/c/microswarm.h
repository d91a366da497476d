/* SPDX-License-Identifier: Apache-2.0 */
/* microswarm for C and languages that call C: experiments, navigators in your own loop, paths.
 *
 * Lengths are in micrometres, times in seconds, angles in radians, counter-clockwise from x.
 *
 * Handles are numbers that are never reused; 0 is no handle. Each is closed by ms_close.
 * Every function that can fail returns a code of ms_code; ms_error_text returns the reason, one
 * line for each mistake, until the next call of the same thread.
 *
 * Threads: calls with different handles may be made in different threads at the same time. A call
 * with a handle that another thread is using fails with MS_BAD_CALL. ms_stop may be called from any
 * thread. Text and numbers that a function points to belong to the handle and are valid until the
 * next call with it.
 *
 * Versions: functions, structures and codes of an interface version stay as they are; MS_INTERFACE
 * grows when something is added. */
#ifndef MICROSWARM_H
#define MICROSWARM_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this header. ms_interface is that of the library: at least this one, if it fits. */
enum { MS_INTERFACE = 3 };

/* Return codes. */
typedef enum ms_code {
  MS_OK = 0,
  MS_END = 1,       /* the run has ended: there is no further tick */
  MS_BAD_INPUT = 2, /* a file, key or value; nothing has changed */
  MS_STOPPED = 3,   /* ms_stop ended the call: ms_plan, ms_navigator_step, ms_session_finish */
  MS_BAD_CALL = 4,  /* a pointer is null, or the handle is closed, of another kind, or in use */
  MS_NO_MEMORY = 5,
  MS_FAULT = 6 /* a bug of the library */
} ms_code;

/* Version of the library, three numbers with points. */
const char* ms_version(void);
int32_t ms_interface(void);
/* Reason of this thread's last failed call; empty before. */
const char* ms_error_text(void);
/* One mistake of that call. No text is null; one is empty where it is unknown. */
typedef struct ms_issue {
  const char* key;   /* the value's, from the top: "obstacles.3.shape.radius_um" */
  const char* place; /* where it was given: "flight.yaml:12:3", a file, or the key of a setting */
  const char* text;  /* what is wrong */
  const char* value; /* as written */
  const char* limit; /* what is allowed: "0..1e5 um", or words */
} ms_issue;
/* The mistakes behind ms_error_text, of which it shows 20; the texts are valid as long as that. An
 * error that is not MS_BAD_INPUT is one issue with a text. MS_BAD_CALL if there is no issue i,
 * counted from 0. */
size_t ms_issue_count(void);
int32_t ms_issue_at(size_t i, ms_issue* issue);
/* Closes a session, navigator, map or path. */
int32_t ms_close(uint64_t handle);
/* Ends the call of another thread with a map or a navigator, and the run of a session
 * permanently: its next tick is the last one. */
int32_t ms_stop(uint64_t handle);

/* ---- Experiments ---------------------------------------------------------------------------- */

/* A tick of an experiment: what was recorded in interface version 1; ms_frame_columns lists
 * all quantities. Absent ones are NaN. */
typedef struct ms_frame {
  double t_s;  /* start of the tick */
  double x_um; /* centre of the swarm */
  double y_um;
  double heading_rad;
  double radius_um; /* 0 for robots */
  double speed_um_per_s;
  double command_heading_rad; /* command of the navigator */
  double command_speed_um_per_s;
  double goal_distance_um;
  double wall_clearance_um; /* from the centre; infinite for robots */
  double obstacle_clearance_um;
  double avoidance_cost; /* delta, Eq 4 [radar] */
  double target_x_um;    /* local target of the navigator */
  double target_y_um;
  int32_t state;   /* of the navigator; compare by ms_state_name */
  int32_t planned; /* 1 if it called a planner */
} ms_frame;

/* Opens a scenario file, or a record for playback. `settings` are `count` texts "KEY=VALUE". */
int32_t ms_session_open(const char* file, const char* const* settings, size_t count,
                        uint64_t* session);
/* Opens a scenario from YAML text. File names in it are relative to `folder`; null: the current
 * one. */
int32_t ms_session_open_text(const char* text, const char* folder, const char* const* settings,
                             size_t count, uint64_t* session);
/* A scenario: a file or a text, the other one null. With all other members zero it is that of
 * ms_session_open. */
typedef struct ms_scenario {
  const char* file; /* for a session also a record, without settings and trial */
  const char* text;
  const char* folder; /* of file names in the text; null: the current one */
  const char* const* settings;
  size_t setting_count;
  uint32_t trial; /* selects the random streams: trial k is that of `microswarm run --trials` */
} ms_scenario;

/* Opens one trial of a scenario. */
int32_t ms_session_open_trial(const ms_scenario* scenario, uint64_t* session);
/* The next tick; `frame` may be null. MS_END after the last one. */
int32_t ms_session_step(uint64_t session, ms_frame* frame);
/* Steps to the end. */
int32_t ms_session_finish(uint64_t session);
/* Sets a value from the next tick on, written as in a scenario. */
int32_t ms_session_set(uint64_t session, const char* key, const char* value);
/* "running", or the final status: "solved", "collided", "time_limit", ... */
int32_t ms_session_status(uint64_t session, const char** status);
/* A metric by its name, for example "length_um" or "walls_clearance_um". */
int32_t ms_session_metric(uint64_t session, const char* name, double* value);
/* All metrics as JSON. */
int32_t ms_session_metrics(uint64_t session, const char** json);
/* Current positions x0, y0, x1, ... of robots, obstacles (x, y, radius of a circle around each) and
 * the followed path; null and 0 without any. `count` is the number of positions. */
int32_t ms_session_robots(uint64_t session, const double** xy_um, size_t* count);
int32_t ms_session_obstacles(uint64_t session, const double** xyr_um, size_t* count);
int32_t ms_session_path(uint64_t session, const double** xy_um, size_t* count);
/* All frames so far, or all of a record; after the last tick there is one more for the end. */
int32_t ms_session_frames(uint64_t session, const ms_frame** frames, size_t* count);

/* How the values of a recorded quantity are to be read. */
typedef enum ms_kind {
  MS_REAL = 0,
  MS_INTEGER = 1,
  MS_BOOLEAN = 2, /* 0 or 1 */
  MS_WORD = 3     /* index, from 0, into the words of the column */
} ms_kind;

/* A quantity that is recorded each tick: a column of the table /frames of a record. */
typedef struct ms_column {
  const char* name;    /* ends with its unit: "goal_distance_um" */
  const char* unit;    /* "µm", "rad", ...; "" for none */
  const char* meaning; /* one sentence */
  const char* const* words;
  size_t word_count; /* 0 unless the kind is MS_WORD */
  int32_t kind;      /* of ms_kind */
  int32_t reserved;
} ms_column;

/* All recorded quantities, in the order of a record; valid until the process ends. */
int32_t ms_frame_columns(const ms_column** columns, size_t* count);
/* A recorded quantity by its name, a value for each of ms_session_frames. NaN: not there. */
int32_t ms_session_column(uint64_t session, const char* name, const double** values, size_t* count);
/* All quantities at the current tick, a value for each of ms_frame_columns. */
int32_t ms_session_values(uint64_t session, const double** values, size_t* count);
/* Fingerprint of the record so far: equal for equal runs. */
int32_t ms_session_hash(uint64_t session, const char** hash);
/* Writes the record (HDF5). */
int32_t ms_session_record(uint64_t session, const char* file);

/* ---- A navigator in your own loop ------------------------------------------------------------ */

/* An obstacle that the camera sees: a disc, or an outline x0, y0, x1, ... of `points` corners. */
typedef struct ms_obstacle {
  double x_um;
  double y_um;
  double radius_um;
  const double* outline_um; /* null for a disc */
  size_t points;
  int32_t number; /* >= 0, constant over all pictures; see ms_observation */
} ms_obstacle;

/* What the camera detected. */
typedef struct ms_observation {
  double now_s;      /* current time */
  double seen_s;     /* when the picture was taken */
  int32_t has_swarm; /* 0 if not detected, and for robots */
  int32_t numbered;  /* 1 if obstacles have numbers; 0: they are matched by distance */
  double x_um;
  double y_um;
  double heading_rad;
  double radius_um;
  const ms_obstacle* obstacles;
  size_t obstacle_count;
  const double* robots_um; /* x0, y0, x1, ...; index i is the same robot in every picture */
  size_t robot_count;
  int32_t unseen;   /* number of robots that were not detected, at expected positions */
  int32_t reserved; /* 0 */
} ms_observation;

/* Command until the next one. Speed 0 is a hold. */
typedef struct ms_command {
  double heading_rad;
  double speed_um_per_s;
  double target_x_um; /* local target; NaN without one */
  double target_y_um;
  int32_t state;   /* compare by ms_state_name: names are stable, numbers are not */
  int32_t planned; /* 1 if a planner was called */
} ms_command;

/* The navigator of a scenario with its map, swarm or robots, and goal. */
int32_t ms_navigator_open(const char* file, const char* const* settings, size_t count,
                          uint64_t* navigator);
int32_t ms_navigator_open_text(const char* text, const char* folder, const char* const* settings,
                               size_t count, uint64_t* navigator);
int32_t ms_navigator_open_trial(const ms_scenario* scenario, uint64_t* navigator);
/* The command for an observation. A refused observation changes nothing. */
int32_t ms_navigator_step(uint64_t navigator, const ms_observation* seen, ms_command* command);
/* The path that it follows: x0, y0, x1, ... */
int32_t ms_navigator_path(uint64_t navigator, const double** xy_um, size_t* count);
/* Name of a state: "follow", "hold", "arrived", "blind", ...; "" for an unknown number. */
const char* ms_state_name(int32_t state);

/* ---- Paths ----------------------------------------------------------------------------------- */

/* Opens a map file; `um_per_px` is the side of a pixel or cell, 0 if the file contains it. */
int32_t ms_map_open(const char* file, double um_per_px, uint64_t* map);
/* The same with keys of `map` in a scenario: "map.um_per_unit=1000", "map.free=dark". */
int32_t ms_map_open_with(const char* file, double um_per_px, const char* const* settings,
                         size_t count, uint64_t* map);
/* What was assumed or left out when the map was read, and of the last plan a path that ends beside
   its goal: a line each, "" if there is nothing. The text belongs to the map's handle. */
int32_t ms_map_notes(uint64_t map, const char** notes);
/* A map from `width` x `height` pixels, upper row first: a mask of 0 and 1, where 1 is free, or
 * else a grey picture, free where a pixel is at least 128, as in a picture's file. One that is all
 * wall is refused, one without walls is noted. */
int32_t ms_map_from_pixels(const uint8_t* pixels, size_t width, size_t height, double um_per_px,
                           uint64_t* map);
/* The same with keys of `map` in a scenario, of a picture: "map.threshold=90", "map.free=dark",
 * "map.simplify_um=2". A mask too is compared with a threshold that is given. */
int32_t ms_map_from_pixels_with(const uint8_t* pixels, size_t width, size_t height,
                                double um_per_px, const char* const* settings, size_t count,
                                uint64_t* map);
/* Extent of a map, and the distance of a position to its walls, 0 inside one. */
int32_t ms_map_bounds(uint64_t map, double* x_lo, double* y_lo, double* x_hi, double* y_hi);
int32_t ms_map_clearance(uint64_t map, double x_um, double y_um, double* clearance_um);

/* A path query. Settings are "planner.KEY=VALUE"; other parameters are fitted to the map. */
typedef struct ms_query {
  double start_x_um;
  double start_y_um;
  double start_heading_rad;
  double goal_x_um;
  double goal_y_um;
  uint64_t seed;
  const char* const* settings;
  size_t setting_count;
} ms_query;

/* Result of a query. */
typedef struct ms_path {
  int32_t solved;   /* 0: the points are the beginning of a path only */
  double length_um; /* of true arcs */
  double turning_rad;
  double time_s;           /* computing time of the planner */
  const double* points_um; /* x0, y0, x1, ... */
  size_t point_count;
  const char* why_none; /* why there is no path; empty with one */
} ms_path;

/* Plans a path. The data that `path` points to belongs to the map's handle. */
int32_t ms_plan(uint64_t map, const ms_query* query, ms_path* path);

#ifdef __cplusplus
}
#endif

#endif
