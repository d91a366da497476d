// SPDX-License-Identifier: Apache-2.0
// mega_simulator FIRMWARE.elf [BOOTLOADER.hex]: an ATmega2560 in real time whose serial line is a
// pseudo-terminal. As on a Mega, opening the port resets it; with a bootloader, that runs first,
// and takes uploads. FIRMWARE.elf may be `-`: a board as it is sold. Prints `port PATH`, then `out
// MS o1 … o6` whenever an output changes (per mille, by the pins' registers), `enable 0` or `enable
// 1`. Takes lines: `cut`, `join` (the cable), `lose P` and `flip P` (a share of the bytes to the
// device), `mute` (the device is heard no more), `reset`, `brownout`, `press`, `release` (the
// emergency stop), `probe N OHMS OHMS` (of the probe at analog input N, at one reading and the
// next), `supply VOLTS`, `trace FILE` (writes the cycle of each change of an output, and the
// outputs), `mark`; answers each with `mark MS`. MS is the device's own time, which stands still
// while the computer has other work. Ends with its standard input.
#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <sstream>
#include <string>
#include <string_view>

#include "microswarm/core/maths/rng.hpp"

extern "C" {
#include <simavr/avr_adc.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_hex.h>
}

namespace microswarm {
namespace {

using Clock = std::chrono::steady_clock;
using Outputs = std::array<int, 6>;

constexpr double frequency = 16e6;
constexpr double slice = 0.001;     // [s] simulated between looks at the line
constexpr double max_late = 0.02;   // [s]
constexpr double start_up = 0.065;  // [s] after a reset, by the fuses of a Mega
constexpr int top = 799;
constexpr int reset_cause = 0x54;  // MCUSR
enum Cause : std::uint8_t { power_on = 1, reset_line = 2, brown_out = 4 };

/// What the pins do, by the registers' addresses in the data sheet.
Outputs outputs_of(const avr_t& avr) {
  constexpr int port_a = 0x22, control_3a = 0x90, width_3a = 0x98, control_4a = 0xA0,
                width_4a = 0xA8;
  Outputs outputs{};
  for (int c = 0; c < 6; ++c) {
    const int of_timer = c % 3;
    const int control = avr.data[c < 3 ? control_3a : control_4a];
    const int at = (c < 3 ? width_3a : width_4a) + 2 * of_timer;
    const int width = avr.data[at] | avr.data[at + 1] << 8;
    const bool connected = (control >> (7 - 2 * of_timer)) & 1;
    if (!connected) continue;
    const int size = (1000 * (width + 1) + top) / (top + 1);
    outputs[static_cast<std::size_t>(c)] = (avr.data[port_a] >> c) & 1 ? -size : size;
  }
  return outputs;
}

class Mega {
 public:
  Mega(const char* firmware, const char* bootloader) {
    elf_firmware_t elf{};
    const bool is_bare = std::string_view(firmware) == "-";
    if (!is_bare && elf_read_firmware(firmware, &elf) != 0) fail("cannot read the firmware");
    avr_ = avr_make_mcu_by_name("atmega2560");
    if (!avr_) fail("knows no atmega2560");
    avr_init(avr_);
    elf.frequency = static_cast<std::uint32_t>(frequency);
    if (is_bare)
      avr_->frequency = elf.frequency;
    else
      avr_load_firmware(avr_, &elf);
    avr_->codeend = avr_->flashend;
    if (bootloader) load(bootloader);
    set_supply(5);
    avr_irq_register_notify(avr_io_getirq(avr_, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_OUT_TRIGGER),
                            on_conversion, this);
    avr_->sleep = [](avr_t*, avr_cycle_count_t) {};  // run() keeps the time
    std::uint32_t flags = 0;
    avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
    flags &= ~static_cast<std::uint32_t>(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
    avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    const auto irq = [&](int n) { return avr_io_getirq(avr_, AVR_IOCTL_UART_GETIRQ('0'), n); };
    input_ = irq(UART_IRQ_INPUT);
    avr_irq_register_notify(irq(UART_IRQ_OUTPUT), on_output, this);
    avr_irq_register_notify(irq(UART_IRQ_OUT_XON), on_room, this);
    avr_irq_register_notify(irq(UART_IRQ_OUT_XOFF), on_full, this);
    contact_ = avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ('C'), 7);
    open_port();
    restart(power_on);
  }

  /// Until the standard input ends.
  void run() {
    auto began = Clock::now();
    Outputs shown{};
    show(shown);
    for (;;) {
      const double own = static_cast<double>(avr_->cycle) / frequency;
      double late = std::chrono::duration<double>(Clock::now() - began).count() - own;
      if (late > max_late) {  // the computer had other work: that time does not count
        began += std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(late - max_late));
        late = max_late;
      }
      // A little at a time, so that no message waits until all is caught up with.
      const auto until = static_cast<avr_cycle_count_t>((own + std::min(late, slice)) * frequency);
      while (avr_->cycle < until) {
        const int state = avr_run(avr_);
        if (state == cpu_Crashed || state == cpu_Done) fail("the firmware crashed");
        if (trace_) follow();
      }
      const Outputs now = outputs_of(*avr_);
      if (now != shown) show(shown = now);
      if (const bool enabled = (avr_->data[0x22] >> 6) & 1; enabled != enabled_) {
        fmt::print("enable {}\n", int{enabled_ = enabled});
        std::fflush(stdout);
      }
      if (!exchange(late > slice ? 0 : 1)) return;
    }
  }

 private:
  [[noreturn]] static void fail(std::string_view why) {
    fmt::print(stderr, "mega_simulator: {}\n", why);
    std::exit(1);
  }

  // What a bootloader's file begins with is where the processor begins.
  void load(const char* bootloader) {
    ihex_chunk_p chunks = nullptr;
    const int count = read_ihex_chunks(bootloader, &chunks);
    if (count <= 0) fail("cannot read the bootloader");
    for (int k = 0; k < count; ++k)
      avr_loadcode(avr_, chunks[k].data, chunks[k].size, chunks[k].baseaddr);
    avr_->reset_pc = chunks[0].baseaddr;
    free_ihex_chunks(chunks);
  }

  void restart(Cause cause) {
    avr_reset(avr_);
    avr_->data[reset_cause] = cause;
    room_ = true;
    waiting_.clear();
    set_contact();
    avr_->cycle += static_cast<avr_cycle_count_t>(start_up * frequency);
  }

  double milliseconds() const { return 1e3 * static_cast<double>(avr_->cycle) / frequency; }

  void show(const Outputs& o) const {
    fmt::print("out {} {} {} {} {} {} {}\n", milliseconds(), o[0], o[1], o[2], o[3], o[4], o[5]);
    std::fflush(stdout);
  }

  // Closed, it pulls the pin down against the pull-up.
  void set_contact() {
    constexpr unsigned pin = 1U << 7;
    avr_ioport_external_t contact{};
    contact.name = 'C';
    contact.mask = pin;
    contact.value = pressed_ ? pin : 0;
    avr_ioctl(avr_, AVR_IOCTL_IOPORT_SET_EXTERNAL('C'), &contact);
    avr_raise_irq(contact_, pressed_);
  }

  void set_supply(double volts) {
    supply_ = volts;
    avr_->vcc = avr_->avcc = avr_->aref = static_cast<std::uint32_t>(std::lround(1e3 * volts));
  }

  static void on_conversion(avr_irq_t*, std::uint32_t mux, void* self) {
    static_cast<Mega*>(self)->convert(mux);
  }
  // A conversion begins: the input's voltage by the divider of probe and resistor.
  void convert(std::uint32_t mux) {
    constexpr double resistor = 2200;  // [Ω] of the firmware's PROBE_OHMS
    avr_adc_mux_t input{};
    std::memcpy(&input, &mux, sizeof mux);
    const auto n = static_cast<std::size_t>(input.src);
    if (n >= probes_.size()) return;
    Probe& probe = probes_[n];
    const double ohms = probe.ohms[probe.conversions++ % 2];
    const double millivolts = 1e3 * supply_ * ohms / (resistor + ohms);
    avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_ADC_GETIRQ, static_cast<int>(n)),
                  static_cast<std::uint32_t>(std::lround(millivolts)));
  }

  // After each instruction, so that times are exact.
  void follow() {
    const Outputs now = outputs_of(*avr_);
    if (now == traced_) return;
    traced_ = now;
    fmt::print(trace_, "{} {} {} {} {} {} {}\n", avr_->cycle, now[0], now[1], now[2], now[3],
               now[4], now[5]);
  }

  void open_port() {
    termios raw{};
    cfmakeraw(&raw);
    std::array<char, 128> name{};
    int other = -1;
    if (openpty(&port_, &other, name.data(), &raw, nullptr) != 0) fail("no pseudo-terminal");
    close(other);
    fcntl(port_, F_SETFL, O_NONBLOCK);
    fmt::print("port {}\n", name.data());
    std::fflush(stdout);
  }

  static void on_output(avr_irq_t*, std::uint32_t byte, void* self) {
    Mega& mega = *static_cast<Mega*>(self);
    const auto sent = static_cast<std::uint8_t>(byte);
    if (!mega.cut_ && !mega.mute_ && mega.open_ && write(mega.port_, &sent, 1) < 0)
      return;  // nobody reads: lost
  }
  static void on_room(avr_irq_t*, std::uint32_t, void* self) {
    Mega& mega = *static_cast<Mega*>(self);
    mega.room_ = true;
    mega.feed();
  }
  static void on_full(avr_irq_t*, std::uint32_t, void* self) {
    static_cast<Mega*>(self)->room_ = false;
  }

  void feed() {
    while (room_ && !waiting_.empty()) {
      const std::uint8_t byte = waiting_.front();
      waiting_.pop_front();
      avr_raise_irq(input_, byte);
    }
  }

  /// Waits for so long [ms] when nothing comes.
  bool exchange(int wait) {
    // A port that nobody has open is always ready, to say so.
    std::array<pollfd, 2> ready{{{STDIN_FILENO, POLLIN, 0}, {port_, POLLIN, 0}}};
    if (poll(ready.data(), open_ ? 2 : 1, wait) < 0) return true;
    if (!open_) poll(&ready[1], 1, 0);
    const bool opened = !(ready[1].revents & POLLHUP);
    if (opened && !open_) restart(reset_line);
    open_ = opened;
    std::array<std::uint8_t, 256> bytes{};
    if (ready[1].revents & POLLIN) {
      const auto n = read(port_, bytes.data(), bytes.size());
      for (std::size_t k = 0; n > 0 && k < static_cast<std::size_t>(n); ++k) take(bytes[k]);
    }
    feed();
    if (!(ready[0].revents & (POLLIN | POLLHUP))) return true;
    const auto n = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (n <= 0) return false;
    orders_.append(bytes.begin(), bytes.begin() + n);
    for (std::size_t end; (end = orders_.find('\n')) != std::string::npos;
         orders_.erase(0, end + 1))
      obey(orders_.substr(0, end));
    return true;
  }

  void take(std::uint8_t byte) {
    if (cut_ || rng_.uniform(0, 1) < lost_) return;
    if (rng_.uniform(0, 1) < flipped_) byte ^= static_cast<std::uint8_t>(1u << rng_.below(8));
    waiting_.push_back(byte);
  }

  void obey(const std::string& line) {
    std::istringstream words(line);
    std::string order;
    words >> order;
    if (order == "cut") cut_ = true;
    if (order == "join") cut_ = false;
    if (order == "lose") words >> lost_;
    if (order == "flip") words >> flipped_;
    if (order == "mute") mute_ = true;
    if (order == "reset") restart(reset_line);
    if (order == "brownout") restart(brown_out);
    if (order == "press" || order == "release") {
      pressed_ = order == "press";
      set_contact();
    }
    if (order == "supply") {
      double volts = 5;
      words >> volts;
      set_supply(volts);
    }
    if (order == "probe") {
      std::size_t n = 0;
      words >> n;
      if (n < probes_.size()) words >> probes_[n].ohms[0] >> probes_[n].ohms[1];
    }
    if (order == "trace") {
      std::string file;
      if (trace_) std::fclose(trace_);
      trace_ = words >> file ? std::fopen(file.c_str(), "w") : nullptr;
    }
    fmt::print("mark {}\n", milliseconds());
    std::fflush(stdout);
  }

  avr_t* avr_ = nullptr;
  avr_irq_t* input_ = nullptr;
  int port_ = -1;
  bool room_ = true, cut_ = false, open_ = false, mute_ = false;
  bool pressed_ = false, enabled_ = false;
  avr_irq_t* contact_ = nullptr;
  struct Probe {
    std::array<double, 2> ohms{1e9, 1e9};  // open
    unsigned conversions = 0;
  };
  std::array<Probe, 6> probes_;
  double supply_ = 5;  // [V]
  std::FILE* trace_ = nullptr;
  Outputs traced_{};
  double lost_ = 0, flipped_ = 0;
  std::deque<std::uint8_t> waiting_;
  std::string orders_;
  Rng rng_{1, Purpose::test};
};

}  // namespace
}  // namespace microswarm

int main(int count, char** arguments) {
  if (count != 2 && count != 3) {
    fmt::print(stderr, "usage: mega_simulator FIRMWARE.elf [BOOTLOADER.hex]\n");
    return 2;
  }
  microswarm::Mega(arguments[1], count == 3 ? arguments[2] : nullptr).run();
  return 0;
}
