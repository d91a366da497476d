/* SPDX-License-Identifier: Apache-2.0 */
/* Converts values of MATLAB and Octave to those of the C interface and back; an invalid one ends
 * the call with an error that names it. */
#ifndef MICROSWARM_MEX_VALUES_H
#define MICROSWARM_MEX_VALUES_H

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "mex.h"
#include "microswarm.h"

/* What was refused here; empty if the library was the last to fail. */
static char refused[1000];

static void fail(const char* id, const char* format, ...) {
  va_list values;
  va_start(values, format);
  vsnprintf(refused, sizeof refused, format, values);
  va_end(values);
  mexErrMsgIdAndTxt(id, "%s", refused);
}

#define REFUSE(...) fail("microswarm:bad_input", __VA_ARGS__)

/* Raises an error unless a call of the library succeeded. */
static void check(int32_t code) {
  static const char* const ids[] = {"microswarm:bad_input", "microswarm:stopped",
                                    "microswarm:bad_call", "microswarm:no_memory",
                                    "microswarm:fault"};
  if (code == MS_OK || code == MS_END) return;
  refused[0] = 0;
  mexErrMsgIdAndTxt(ids[code >= MS_BAD_INPUT && code <= MS_FAULT ? code - MS_BAD_INPUT : 4], "%s",
                    ms_error_text());
}

/* ---- Arguments ------------------------------------------------------------------------------- */

static int is_plain_number(const mxArray* a) {
  return mxIsNumeric(a) && !mxIsComplex(a) && !mxIsSparse(a);
}

static double number(const mxArray* a, const char* name) {
  if (!is_plain_number(a) || mxGetNumberOfElements(a) != 1)
    REFUSE("%s must be one real number, but is of class %s with %lu elements%s", name,
           mxGetClassName(a), (unsigned long)mxGetNumberOfElements(a),
           mxIsComplex(a) ? ", complex" : "");
  return mxGetScalar(a);
}

static double whole(const mxArray* a, const char* name, double most) {
  const double value = number(a, name);
  if (!(value >= 0 && value <= most && floor(value) == value))
    REFUSE("%s is %g, must be a whole number from 0 to %.0f", name, value, most);
  return value;
}

static uint64_t handle_of(const mxArray* a) {
  if (!mxIsUint64(a) || mxIsComplex(a) || mxGetNumberOfElements(a) != 1)
    fail("microswarm:bad_call", "the handle must be a uint64, but is of class %s",
         mxGetClassName(a));
  return *(const uint64_t*)mxGetData(a);
}

/* Element i of real numbers of any class. */
static double element(const mxArray* a, size_t i) {
  const void* data = mxGetData(a);
  switch (mxGetClassID(a)) {
    case mxDOUBLE_CLASS:
      return ((const double*)data)[i];
    case mxSINGLE_CLASS:
      return ((const float*)data)[i];
    case mxINT8_CLASS:
      return ((const int8_t*)data)[i];
    case mxUINT8_CLASS:
      return ((const uint8_t*)data)[i];
    case mxINT16_CLASS:
      return ((const int16_t*)data)[i];
    case mxUINT16_CLASS:
      return ((const uint16_t*)data)[i];
    case mxINT32_CLASS:
      return ((const int32_t*)data)[i];
    case mxUINT32_CLASS:
      return ((const uint32_t*)data)[i];
    case mxINT64_CLASS:
      return (double)((const int64_t*)data)[i];
    case mxUINT64_CLASS:
      return (double)((const uint64_t*)data)[i];
    default:
      return NAN;
  }
}

/* The rows of a matrix in sequence, as the library expects them; null for an empty matrix. */
static double* rows_of(const mxArray* a, const char* name, size_t columns, size_t* rows) {
  size_t row, column;
  double* all;
  *rows = 0;
  if (!is_plain_number(a))
    REFUSE("%s must be a matrix of real numbers, but is of class %s%s%s", name, mxGetClassName(a),
           mxIsComplex(a) ? ", complex" : "", mxIsSparse(a) ? ", sparse" : "");
  if (mxIsEmpty(a)) return NULL;
  if (mxGetNumberOfDimensions(a) != 2 || mxGetN(a) != columns)
    REFUSE("%s must have %lu columns, but has the size %lu x %lu", name, (unsigned long)columns,
           (unsigned long)mxGetM(a), (unsigned long)mxGetN(a));
  *rows = mxGetM(a);
  all = mxMalloc(*rows * columns * sizeof *all);
  for (row = 0; row < *rows; ++row)
    for (column = 0; column < columns; ++column)
      all[row * columns + column] = element(a, row + column * *rows);
  return all;
}

/* A vector, row or column, of `least` to `most` numbers. */
static size_t vector(const mxArray* a, const char* name, size_t least, size_t most, double* out) {
  const size_t count = mxGetNumberOfElements(a);
  size_t i;
  if (!is_plain_number(a) || mxGetM(a) + mxGetN(a) != count + 1 || count < least || count > most)
    REFUSE("%s must be %lu real numbers, but is of class %s with the size %lu x %lu%s", name,
           (unsigned long)least, mxGetClassName(a), (unsigned long)mxGetM(a),
           (unsigned long)mxGetN(a), mxIsComplex(a) ? ", complex" : "");
  for (i = 0; i < count; ++i) out[i] = element(a, i);
  return count;
}

static char* text_of(const mxArray* a, const char* name) {
  const size_t count = mxGetNumberOfElements(a);
  char* text;
  size_t i;
  if (!mxIsChar(a) || (count > 0 && (mxGetM(a) != 1 || mxGetN(a) != count)))
    REFUSE("%s must be a text of one row, but is of class %s", name, mxGetClassName(a));
  for (i = 0; i < count; ++i)
    if (mxGetChars(a)[i] == 0) REFUSE("%s has a zero character", name);
  text = mxCalloc(4 * count + 1, 1); /* mxArrayToString leaks in Octave */
  if (count > 0 && mxGetString(a, text, 4 * count + 1) != 0)
    REFUSE("%s cannot be read as text", name);
  return text;
}

typedef struct texts {
  const char** all;
  size_t count;
} texts;

static texts settings_of(const mxArray* a) {
  texts made = {NULL, 0};
  size_t i;
  if (!mxIsCell(a)) REFUSE("settings must be a cell array of texts, not %s", mxGetClassName(a));
  made.count = mxGetNumberOfElements(a);
  made.all = mxCalloc(made.count + 1, sizeof *made.all);
  for (i = 0; i < made.count; ++i) {
    const mxArray* one = mxGetCell(a, i);
    if (!one) REFUSE("setting %lu is empty", (unsigned long)i + 1);
    made.all[i] = text_of(one, "a setting");
  }
  return made;
}

/* ---- Results --------------------------------------------------------------------------------- */

static mxArray* matrix_of(const double* rows, size_t count, size_t columns) {
  mxArray* made = mxCreateDoubleMatrix(count, columns, mxREAL);
  double* out = mxGetPr(made);
  size_t row, column;
  for (row = 0; row < count; ++row)
    for (column = 0; column < columns; ++column)
      out[row + column * count] = rows[row * columns + column];
  return made;
}

static mxArray* target_of(double x, double y) {
  const double xy[2] = {x, y};
  return isnan(x) ? mxCreateDoubleMatrix(0, 0, mxREAL) : matrix_of(xy, 1, 2);
}

#endif
