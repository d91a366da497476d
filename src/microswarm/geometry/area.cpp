// SPDX-License-Identifier: Apache-2.0
#include "microswarm/geometry/area.hpp"
