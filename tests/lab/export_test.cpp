// SPDX-License-Identifier: Apache-2.0
// Videos that nobody waits for any more.
#include "tests/lab/client.hpp"

namespace microswarm::lab {
namespace {

TEST(Export, AVideoThatNobodyWaitsForIsStopped) {
  const Lab lab;
  const std::uint64_t session = open(lab);
  const std::string path = "/api/sessions/" + std::to_string(session);
  TestPage page(lab, session);
  page.does({{"do", "speed"}, {"number", 0}});
  page.does({{"do", "play"}});
  page.ends();
  const auto share = [&] { return Json::parse(get(lab, path + "/export").body())["share"]; };
  {
    asio::io_context io;
    beast::tcp_stream stream(io);
    stream.connect(lab.endpoint());
    http::request<http::empty_body> request{http::verb::get,
                                            path + "/run.mp4?speed=0.01&width=3840", 11};
    request.set(http::field::host, lab.host);
    request.set(http::field::cookie, "microswarm_" + std::to_string(lab.port) + "=" + lab.token);
    http::write(stream, request);
    for (int i = 0; i < 600 && (share().is_null() || share() == 0); ++i)
      std::this_thread::sleep_for(50ms);
    EXPECT_GT(share(), 0);
    EXPECT_LT(share(), 1);
  }
  // The video would take hours, and the picture waits for it.
  EXPECT_EQ(get(lab, path + "/picture.svg?t=1").result(), http::status::ok);
  EXPECT_TRUE(share().is_null());
}

TEST(Export, AVideoIsStoppedAtTheEnd) {
  Lab lab;
  const std::uint64_t session = open(lab);
  TestPage page(lab, session);
  page.does({{"do", "speed"}, {"number", 0}});
  page.does({{"do", "play"}});
  page.ends();
  std::thread asks([&] {
    asio::io_context io;
    beast::tcp_stream stream(io);
    stream.connect(lab.endpoint());
    http::request<http::empty_body> request{
        http::verb::get,
        "/api/sessions/" + std::to_string(session) + "/run.mp4?speed=0.01&width=3840", 11};
    request.set(http::field::host, lab.host);
    request.set(http::field::cookie, "microswarm_" + std::to_string(lab.port) + "=" + lab.token);
    http::write(stream, request);
    std::this_thread::sleep_for(200ms);
  });
  asks.join();
  lab.end();  // hours later if the video went on
}

}  // namespace
}  // namespace microswarm::lab
