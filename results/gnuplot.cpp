#include "results/gnuplot.hpp"

#include <algorithm>
#include <array>
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

/// The figure's outer parts, then the same plot in both formats.
std::string plotting_script(const GnuplotFigure& figure, const std::filesystem::path& stem) {
  std::string script = fmt::format(
      "set title {} offset 0,0.4\nset border linewidth 0.8\n{}\n", gnuplot_text(figure.title),
      figure.key_rows > 0
          ? fmt::format("set key below center horizontal Left reverse maxrows {} samplen 1 width 1 "
                        "height 1.4 font ',13'",
                        figure.key_rows)
          : "unset key");
  const auto output = [&](std::string_view terminal, const char* extension) {
    script +=
        fmt::format("set terminal {}\nset output {}\nplot {}\nunset output\n", terminal,
                    gnuplot_text(stem.string() + extension), fmt::join(figure.plots, ", \\\n  "));
  };
  output("svg size 760,600 dynamic noenhanced font 'sans-serif,15' background 'white'", ".svg");
  output(
      "pngcairo size 1140,900 noenhanced font 'Sans,16' fontscale 1.1 linewidth 1.5 "
      "pointscale 1.5 background 'white'",
      ".png");
  return script;
}

/// Runs gnuplot on a script.
/// @return why it failed; nothing where it did not
std::optional<std::string> run_gnuplot(const std::string& script,
                                       const std::filesystem::path& stem) {
  const std::string script_file = stem.string() + ".gnuplot.part";
  const std::string log_file = stem.string() + ".log.part";
  const auto finish = [&](std::optional<std::string> failure) {
    for (const std::string& file : {script_file, log_file}) {
      std::error_code ignored;
      std::filesystem::remove(file, ignored);
    }
    return failure;
  };
  std::ofstream stream(script_file);
  stream << script;
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
    quoted += character;
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

std::optional<std::string> draw(const std::string& script, const GnuplotFigure& figure,
                                const std::filesystem::path& stem) {
  return run_gnuplot("set encoding utf8\n" + script + plotting_script(figure, stem), stem);
}

}  // namespace nlcwfs
