// SPDX-License-Identifier: Apache-2.0
// What a rig's kinds of drivers and cameras can do.
#include <gtest/gtest.h>

#include "microswarm/core/errors/error.hpp"
#include "microswarm/rig/runtime/devices.hpp"
#include "tests/files.hpp"
#include "tests/messages.hpp"

namespace microswarm::rig {
namespace {

using test::Folder;

class RigKinds : public testing::Test {
 protected:
  Rig rig(const std::string& driver, const std::string& camera = "{type: simulated}") const {
    folder_.with("coils.yaml", "coils: {type: helmholtz}\n");
    return read_rig(folder_.with(
        "rig.yaml",
        "coils: coils.yaml\nfield: {kind: rotating, amplitude_mt: 8, frequency_hz: 10, "
        "max_pitch_deg: 7.5}\ndrive_rate_hz: 100\ndriver: " +
            driver + "\ncamera: " + camera + "\n"));
  }

  Folder folder_;
};

const std::vector<std::string> device_drivers{
    "{type: serial, port: /dev/none, boot_time_s: 0, connect_timeout_s: 0.1}",
    "{type: program, command: [./none], connect_timeout_s: 0.1}",
    "{type: socket, host: ./none, connect_timeout_s: 0.1}"};

TEST_F(RigKinds, ADeviceThatIsNotThereIsNeverSimulated) {
  ASSERT_EQ(device_drivers.size() + 1, std::variant_size_v<decltype(RigParams::driver)>);
  const Rig simulated = rig("{type: simulated}");
  EXPECT_FALSE(has_coil_device(simulated));
  EXPECT_NE(open_coils(simulated), nullptr);
  for (const std::string& driver : device_drivers) {
    EXPECT_TRUE(has_coil_device(rig(driver))) << driver;
    EXPECT_THROW(open_coils(rig(driver)), HardwareError) << driver;
  }
}

TEST_F(RigKinds, ChannelsAndFullScaleAreTheDrivers) {
  const auto channels = [&](const std::string& driver) {
    const Rig r = rig(driver);
    return channel_count(r.params, r.system);
  };
  EXPECT_EQ(channels("{type: simulated, channels: 9}"), 9);
  EXPECT_EQ(channels(device_drivers[0]), actuation::coil_link_channels);
  EXPECT_EQ(channels(device_drivers[1]), 3);  // one for each coil
  EXPECT_EQ(channels("{type: socket, channels: 5}"), 5);
  EXPECT_EQ(driver_full_scale(rig("{type: program, command: [a], full_scale_a: 7}").params), 7);
}

TEST_F(RigKinds, WhoTurnsTheFieldAndWhoTakesIt) {
  const auto input = [&](const std::string& driver) { return coil_input(rig(driver).params); };
  EXPECT_EQ(input("{type: simulated, waveforms: true}"), actuation::CoilInput::waveform);
  EXPECT_EQ(input("{type: serial, waveforms: true}"), actuation::CoilInput::waveform);
  EXPECT_EQ(input("{type: program, command: [a], send: field}"), actuation::CoilInput::field);
  EXPECT_EQ(input("{type: socket, send: field}"), actuation::CoilInput::field);
  EXPECT_EQ(input("{type: simulated}"), actuation::CoilInput::currents);
  for (const std::string& driver : device_drivers)
    EXPECT_EQ(input(driver), actuation::CoilInput::currents) << driver;
}

TEST_F(RigKinds, CamerasAreSimulatedDevicesOrVideos) {
  struct Expected {
    const char* camera;
    CameraKind kind;
    bool drawn;
  };
  const std::vector<Expected> all{{"{type: simulated}", CameraKind::simulated, true},
                                  {"{type: v4l2}", CameraKind::device, false},
                                  {"{type: genicam, device: Vendor-1}", CameraKind::device, false},
                                  {"{type: video, file: none.mp4}", CameraKind::video, false}};
  ASSERT_EQ(all.size(), std::variant_size_v<decltype(RigParams::camera)>);
  for (const Expected& expected : all) {
    const Rig r = rig("{type: simulated}", expected.camera);
    EXPECT_EQ(camera_kind(r.params), expected.kind) << expected.camera;
    EXPECT_EQ(device_camera(r.params).has_value(), expected.kind == CameraKind::device);
    EXPECT_EQ(shows_drawn_swarm(r.params), expected.drawn) << expected.camera;
  }
  EXPECT_EQ(open_rig_camera(rig("{type: simulated}")), nullptr);
  EXPECT_THROW(open_rig_camera(rig("{type: simulated}", all[3].camera)), InputError);
}

TEST_F(RigKinds, TheDeadmanGivesANavigatorTwoTicks) {
  Rig any = rig("{type: simulated}");
  EXPECT_EQ(deadman(any, 0.1), 0.5);
  EXPECT_EQ(deadman(any, 2.5), 5);
  any.params.safety.deadman = 3;
  EXPECT_EQ(deadman(any, 0.1), 3);
  EXPECT_EQ(deadman(any, 1.5), 3);
  EXPECT_TRUE(test::names(test::error_of([&] { deadman(any, 2.5); }), "safety.deadman_s is 3"));
}

}  // namespace
}  // namespace microswarm::rig
