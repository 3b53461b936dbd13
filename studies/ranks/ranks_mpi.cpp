// Trials are shared with other processes by MPI.
#include "model/input_error.hpp"
#include "objectives/design_trial.hpp"
#include "results/archive/performance_record.hpp"
#include "results/tables/design_summary.hpp"
#include "studies/ranks/launched_processes.hpp"
#include "studies/ranks/ranks.hpp"
#include "studies/ranks/trial_queue.hpp"
#include "studies/settings/text.hpp"
#include "studies/settings/trials.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <list>
#include <map>
#include <mpi.h>
#include <optional>
#include <sched.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/concurrent_queue.h>
#include <tbb/task_arena.h>

namespace nlcwfs {
namespace {

using Json = nlohmann::ordered_json;
using Bytes = std::vector<std::uint8_t>;

// Messages are arrays as CBOR.
enum Tag {
  trial_tag,   ///< from rank 0: place, threads, DesignTrial::identity, DesignTrial::spec
  piece_tag,   ///< from rank 0: number, place of the trial, first screen, screens, design
  end_tag,     ///< from rank 0: empty
  answer_tag,  ///< to rank 0: number of the piece, Answer, and performance_record, the text of the
               ///< failure, or the parts of the InputError
};

enum class Answer {
  performances,
  failure,    ///< of the design
  bad_input,  ///< the design is none
};

/// Trials that a rank holds at once: a search has four, of which each has its screens.
constexpr std::size_t trials_held = 4;

/// Waits without burning a core, and longer the longer nothing happens.
class Nap {
 public:
  void reset() { length_ = shortest; }
  void sleep() {
    std::this_thread::sleep_for(length_);
    length_ = std::min(2 * length_, longest);
  }

 private:
  static constexpr std::chrono::microseconds shortest{20};
  static constexpr std::chrono::microseconds longest{5000};
  std::chrono::microseconds length_ = shortest;
};

[[noreturn]] void end_all_ranks(const std::string& message) {
  std::fflush(stdout);
  std::fputs(fmt::format("nlcwfs: failed: {}\n", one_line(message)).c_str(), stderr);
  std::fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
  std::abort();
}

std::string machine_name() {
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  return {name.data(), static_cast<std::size_t>(length)};
}

void send(const Bytes& bytes, int rank, Tag tag) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

struct Message {
  int rank;  ///< that has sent it
  int tag;
  Bytes bytes;
};

/// The next message that is there.
std::optional<Message> receive() {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
  if (is_there == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

/// A rank that simulates for rank 0. One thread talks to that, others simulate.
class Server {
 public:
  Server() = default;
  ~Server() {
    for (std::size_t i = 0; i < threads_.size(); ++i) pieces_.push({});
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void run() {
    Nap nap;
    for (Bytes answer;;) {
      if (const auto message = receive()) {
        if (message->tag == end_tag) return;
        const Json content = Json::from_cbor(message->bytes);
        message->tag == trial_tag ? take_trial(content) : take_piece(content);
      } else if (answers_.try_pop(answer)) {
        send(answer, 0, answer_tag);
      } else {
        nap.sleep();
        continue;
      }
      nap.reset();
    }
  }

 private:
  using Trial = std::shared_ptr<const DesignTrial>;

  struct Piece {
    Trial trial = nullptr;  // null: there will be no more pieces
    std::uint64_t number = 0;
    int first = 0;
    int count = 0;
    SensorDesign design = {};
  };

  void take_trial(const Json& content) {
    const int threads = content.at(1);
    while (static_cast<int>(threads_.size()) < threads) {
      threads_.emplace_back([this] { simulate_pieces(); });
    }
    Trial& trial = trials_.at(content.at(0).get<std::size_t>());
    trial = nullptr;  // its memory first
    tbb::task_arena(threads).execute(
        [&] { trial = std::make_shared<const DesignTrial>(trial_from_spec(content.at(3))); });
    if (trial->identity() == content.at(2)) return;
    throw std::runtime_error(
        "has other wavefronts than rank 0: all ranks must be of one program on one kind of "
        "processor");
  }

  void take_piece(const Json& content) {
    pieces_.push({.trial = trials_.at(content.at(1).get<std::size_t>()),
                  .number = content.at(0),
                  .first = content.at(2),
                  .count = content.at(3),
                  .design = design_from_json(content.at(4))});
  }

  void simulate_pieces() {
    tbb::task_arena(1).execute([this] {
      for (Piece piece; pieces_.pop(piece), piece.trial;) {
        answers_.push(Json::to_cbor(answer_of(piece)));
      }
    });
  }

  static Json answer_of(const Piece& piece) {
    try {
      return {piece.number, Answer::performances,
              Json::binary(performance_record(
                  piece.trial->simulate(piece.design, piece.first, piece.count)))};
    } catch (const InputError& error) {
      return {piece.number, Answer::bad_input,
              Json{error.key(), error.value(), error.allowed(), error.remedy()}};
    } catch (const std::exception& error) {
      return {piece.number, Answer::failure, error.what()};
    }
  }

  std::array<Trial, trials_held> trials_;
  tbb::concurrent_bounded_queue<Piece> pieces_;
  tbb::concurrent_bounded_queue<Bytes> answers_;
  std::vector<std::jthread> threads_;
};

/// Rank 0's side: one thread gives pieces of the queue to the other ranks.
class Manager : public TrialQueue {
 public:
  /// @param threads  of each rank
  explicit Manager(const std::vector<int>& threads)
      : TrialQueue(threads.front(), {threads.begin() + 1, threads.end()}) {
    for (std::size_t i = 1; i < threads.size(); ++i) {
      peers_.push_back({.rank = static_cast<int>(i), .threads = threads[i]});
    }
    talk_ = std::jthread([this](const std::stop_token& stop) { talk(stop); });
  }

 private:
  struct Peer {
    int rank;
    int threads;
    int pieces = 0;                                    // that it has
    std::array<std::string, trials_held> trials = {};  // that it holds, by their identity
    std::size_t next_place = 0;                        // whose trial is the oldest
  };

  struct Sent {
    Bytes bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void talk(const std::stop_token& stop) {
    try {
      talk_until(stop);
    } catch (const std::exception& error) {
      end_all_ranks(fmt::format("rank 0 cannot talk to the others: {}", error.what()));
    }
  }

  void talk_until(const std::stop_token& stop) {
    Nap nap;
    while (!stop.stop_requested() || !sent_.empty()) {
      bool is_idle = true;
      while (const auto message = receive()) {
        take_answer(*message);
        is_idle = false;
      }
      if (hand_out()) is_idle = false;
      std::erase_if(sent_, [](Sent& sent) {
        int is_done = 0;
        MPI_Test(&sent.request, &is_done, MPI_STATUS_IGNORE);
        return is_done != 0;
      });
      is_idle ? nap.sleep() : nap.reset();
    }
  }

  /// Whether there was a piece to give.
  bool hand_out() {
    bool any = false;
    for (const int pieces_per_thread : {1, 2}) {
      // A second piece spares a thread the wait for its next one, but the last ones go to whoever
      // is free first.
      if (pieces_per_thread > 1 && waiting() <= threads() / 2) break;
      for (Peer& peer : peers_) {
        while (peer.pieces < pieces_per_thread * peer.threads) {
          const auto piece = take(static_cast<std::size_t>(peer.rank));
          if (!piece) return any;
          give(peer, *piece);
          any = true;
        }
      }
    }
    return any;
  }

  void give(Peer& peer, const Piece& piece) {
    const DesignTrial& trial = piece.trial();
    const std::string identity = trial.identity();
    auto place = std::ranges::find(peer.trials, identity) - peer.trials.begin();
    if (place == trials_held) {
      place = static_cast<std::ptrdiff_t>(peer.next_place++ % trials_held);
      peer.trials.at(static_cast<std::size_t>(place)) = identity;
      start_sending(peer.rank, trial_tag, {place, peer.threads, identity, trial.spec});
    }
    const Condition& condition = trial.conditions().front();
    start_sending(
        peer.rank, piece_tag,
        {++number_, place, piece.first(), piece.count(),
         to_json(piece.design(), condition.simulation->telescope(), condition.fried_parameter)});
    given_.emplace(number_, std::pair(piece, &peer));
    ++peer.pieces;
  }

  /// Does not wait for the other rank, which may be making a trial's screens.
  void start_sending(int rank, Tag tag, const Json& content) {
    sent_.push_back({.bytes = Json::to_cbor(content)});
    Sent& sent = sent_.back();
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, rank, tag,
              MPI_COMM_WORLD, &sent.request);
    // NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker): talk() tests the request
  }

  void take_answer(const Message& message) {
    const Json content = Json::from_cbor(message.bytes);
    const auto given = given_.extract(content.at(0).get<std::uint64_t>());
    const auto& [piece, peer] = given.mapped();
    --peer->pieces;
    try {
      switch (content.at(1).get<Answer>()) {
        case Answer::performances:
          piece.done(performances_of(content.at(2).get_binary()));
          return;
        case Answer::bad_input: {
          const std::vector<std::string> error = content.at(2);
          throw InputError(error.at(0), error.at(1), error.at(2), error.at(3));
        }
        case Answer::failure:
          throw std::runtime_error(content.at(2));
      }
    } catch (...) {
      piece.failed(std::current_exception());
    }
  }

  std::vector<Peer> peers_;
  std::list<Sent> sent_;
  std::uint64_t number_ = 0;  // of the last piece that was given
  std::map<std::uint64_t, std::pair<Piece, Peer*>> given_;
  std::jthread talk_;
};

/// The cores that this process may run on, less where other ranks share them.
int share_of_cores() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  sched_getaffinity(0, sizeof(mine), &mine);
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  cpu_set_t all;
  MPI_Allreduce(&mine, &all, sizeof(mine), MPI_BYTE, MPI_BOR, machine);
  int ranks = 1;
  MPI_Comm_size(machine, &ranks);
  MPI_Comm_free(&machine);
  return std::clamp(CPU_COUNT(&all) / ranks, 1, std::max(1, CPU_COUNT(&mine)));
}

}  // namespace

Ranks::Ranks() : cores_{tbb::this_task_arena::max_concurrency()} {
  // Alone there is no need of MPI, which may not even start inside a step of a batch system.
  const int processes = launched_processes();
  if (processes <= 1) return;
  int threading = MPI_THREAD_SINGLE;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threading);
  if (threading < MPI_THREAD_SERIALIZED) {
    end_all_ranks("this MPI cannot be used by a program of several threads");
  }
  int count = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  if (count != processes) {
    MPI_Finalize();
    throw std::runtime_error(fmt::format(
        "{} processes were started together, but they find only {} by MPI: start them by the "
        "mpirun of the MPI that the program was built with, or by srun --mpi=pmix",
        processes, count));
  }
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  cores_.assign(static_cast<std::size_t>(count), 0);
  const int cores = share_of_cores();
  MPI_Allgather(&cores, 1, MPI_INT, cores_.data(), 1, MPI_INT, MPI_COMM_WORLD);
  if (rank_ == 0) return;
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
}

Ranks::~Ranks() {
  int is_initialized = 0;
  MPI_Initialized(&is_initialized);
  if (is_initialized == 0) return;
  if (rank_ == 0) {
    for (int rank = 1; rank < count(); ++rank) send({}, rank, end_tag);
  }
  MPI_Finalize();
}

void Ranks::serve() {
  Server server;  // outlives the catch: it would end only when all that waits is simulated
  try {
    server.run();
  } catch (const std::exception& error) {
    end_all_ranks(fmt::format("rank {} on {}: {}", rank_, machine_name(), error.what()));
  }
}

std::shared_ptr<TrialRunner> Ranks::runner(int threads) const {
  if (count() == 1) return nullptr;
  return std::make_shared<Manager>(threads > 0 ? std::vector<int>(cores_.size(), threads) : cores_);
}

}  // namespace nlcwfs
