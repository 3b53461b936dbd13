// gnuplot is run: what all pictures share.
#include "results/pictures/gnuplot.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace nlcwfs {
namespace {

/// How large a picture is, in pixels of the SVG.
struct PictureSize {
  int width = 760;
  int height = 600;
  int font = 15;
};

/// The same commands in both formats.
/// @param stem  an absolute path
std::string in_both_formats(const std::string& commands, const PictureSize& size,
                            const std::string& stem) {
  std::string script;
  const auto output = [&](const std::string& terminal, const char* extension) {
    script += fmt::format("set terminal {}\nset output {}\n{}\nunset output\n", terminal,
                          gnuplot_text(stem + extension), commands);
  };
  output(fmt::format("svg size {},{} dynamic noenhanced font 'sans-serif,{}' background 'white'",
                     size.width, size.height, size.font),
         ".svg");
  output(fmt::format("pngcairo size {},{} noenhanced font 'Sans,{}' fontscale 1.1 linewidth 1.5 "
                     "pointscale 1.5 background 'white'",
                     size.width * 3 / 2, size.height * 3 / 2, size.font + 1),
         ".png");
  return script;
}

std::string plot_command(const std::vector<std::string>& plots) {
  return fmt::format("plot {}", fmt::join(plots, ", \\\n  "));
}

/// Runs gnuplot on commands that draw a picture, with settings before.
/// @return why it failed; nothing where it did not
std::optional<std::string> run_gnuplot(const std::string& settings, const std::string& commands,
                                       const PictureSize& size,
                                       const std::filesystem::path& picture) {
  // Of a name that starts with |, < or ~ gnuplot would make something else.
  const std::string stem = std::filesystem::absolute(picture).string();
  const std::string script_file = stem + ".gnuplot.part";
  const std::string log_file = stem + ".log.part";
  const auto remove = [](const std::string& file) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  };
  const auto finish = [&](std::optional<std::string> failure) {
    remove(script_file);
    remove(log_file);
    return failure;
  };
  // Nothing is written through a link.
  for (const char* extension : {".gnuplot.part", ".log.part", ".svg", ".png"}) {
    remove(stem + extension);
  }
  std::ofstream stream(script_file);
  stream << "set encoding utf8\n" << settings << in_both_formats(commands, size, stem);
  stream.close();
  if (!stream) return finish(fmt::format("cannot write {}", script_file));

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log_file.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  // Without the user's own start-up file.
  std::array<std::string, 3> words{"gnuplot", "--default-settings", script_file};
  std::array<char*, 4> arguments{words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t process = 0;
  const int refusal =
      posix_spawnp(&process, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (refusal != 0) return finish(fmt::format("gnuplot: {}", std::strerror(refusal)));
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return finish(fmt::format("gnuplot: {}", std::strerror(errno)));
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return finish(std::nullopt);
  std::ifstream log(log_file);
  std::string reason;
  for (std::string line; std::getline(log, line);) {
    if (line.find_first_not_of(" \t^") != std::string::npos) reason = line;
  }
  return finish("gnuplot failed" + (reason.empty() ? reason : ": " + reason));
}

}  // namespace

std::string gnuplot_text(std::string_view text) {
  std::string quoted = "'";
  for (const char character : text) {
    if (character == '\'') quoted += '\'';
    // The end of a line would end the text, and what follows would be a command.
    const auto code = static_cast<unsigned char>(character);
    quoted += code < 0x20 || code == 0x7f ? '?' : character;
  }
  return quoted + "'";
}

std::string logarithmic_axis(std::string_view name, const std::vector<double>& values) {
  constexpr double margin = 1.3;
  const double least = std::ranges::min(values) / margin;
  const double greatest = std::ranges::max(values) * margin;
  // More would stand on each other.
  const std::vector<double> factors =
      greatest > 1e4 * least ? std::vector{1.0} : std::vector{1.0, 2.0, 5.0};
  std::string tics;
  const auto last = static_cast<int>(std::floor(std::log10(greatest)));
  for (auto decade = static_cast<int>(std::floor(std::log10(least))); decade <= last; ++decade) {
    for (const double factor : factors) {
      const double tic = factor * std::pow(10.0, decade);
      if (tic < least || tic > greatest) continue;
      tics += fmt::format("{}'{:g}' {:g}", tics.empty() ? "" : ", ", tic, tic);
    }
  }
  return fmt::format("set logscale {0}\nset {0}range [{1}:{2}]\nset {0}tics out nomirror ({3})\n",
                     name, least, greatest, tics);
}

double lower_end(double value, double error) { return std::max(value - error, 0.1 * value); }

std::string data_block(std::string_view name, const std::string& rows) {
  return fmt::format("${} << END_OF_DATA\n{}END_OF_DATA\n", name, rows);
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "NaN";
}

std::optional<std::string> draw(const std::string& title, int key_rows, const GnuplotPanel& panel,
                                const std::filesystem::path& stem) {
  const std::string outer_parts = fmt::format(
      "set title {} offset 0,0.4\nset border linewidth 0.8\n{}\n", gnuplot_text(title),
      key_rows > 0
          ? fmt::format("set key below center horizontal Left reverse maxrows {} samplen 1 width 1 "
                        "height 1.4 font ',13'",
                        key_rows)
          : "unset key");
  return run_gnuplot(panel.settings + outer_parts, plot_command(panel.plots), {}, stem);
}

std::optional<std::string> draw(const GnuplotPanels& figure, const std::filesystem::path& stem) {
  constexpr int font = 13;
  constexpr int title_height = 36;
  const PanelRoom& room = figure.room;
  const int width = room.left + room.width + room.right;
  const int height = room.above + room.height + room.below;
  const auto columns = static_cast<int>(figure.columns);
  const auto rows = (static_cast<int>(figure.panels.size()) + columns - 1) / columns;
  const PictureSize size{
      .width = columns * width, .height = rows * height + title_height, .font = font};
  std::string commands =
      fmt::format("set multiplot title {} font ',{}'\n", gnuplot_text(figure.title), font + 1);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const auto number = static_cast<int>(i);
    const int left = number % columns * width + room.left;
    const int above = title_height + number / columns * height + room.above;
    const auto edge = [](const char* name, int pixels, int whole) {
      return fmt::format("set {}margin at screen {}\n", name, double(pixels) / whole);
    };
    const GnuplotPanel& panel = figure.panels[i];
    commands += "reset\nset border linewidth 0.8\nunset key\n" + edge("l", left, size.width) +
                edge("r", left + room.width, size.width) +
                edge("t", size.height - above, size.height) +
                edge("b", size.height - above - room.height, size.height) + panel.settings +
                plot_command(panel.plots) + '\n';
  }
  return run_gnuplot("", commands + "unset multiplot", size, stem);
}

}  // namespace nlcwfs
