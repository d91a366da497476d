// SPDX-License-Identifier: Apache-2.0
// A camera of GigE Vision at 127.0.0.1, until the end of its input. Says "ready" or "taken" first.
#include <arv.h>

#include <cstdio>

int main() {
  ArvGvFakeCamera* const camera = arv_gv_fake_camera_new("lo", "test");
  const bool runs = camera && arv_gv_fake_camera_is_running(camera) != 0;
  std::puts(runs ? "ready" : "taken");
  std::fflush(stdout);
  while (runs && std::getchar() != EOF) continue;
  if (camera) g_object_unref(camera);
  return runs ? 0 : 1;
}
