// Noise-free images are kept for the next design that reads the same plane.
#pragma once

#include "model/array.hpp"
#include "model/light_source.hpp"

#include <compare>
#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace nlcwfs {

/// Noise-free detector images, kept for the next design that reads the same plane with the same
/// detector: designs of a search or a sweep share most of theirs. Holds a bounded amount of memory,
/// of which the images that were not asked for the longest go first. May be used by many threads.
class ImageCache {
 public:
  /// What an image depends on, with one telescope, truth, set of screens and
  /// spectrum within its bands.
  struct Key {
    std::size_t screen;  ///< number of the wavefront, from 0
    double plane;        ///< signed distance, m
    int width;           ///< of the detector, pixels
    int pupil_pixels;    ///< across the pupil
    Band band;           ///< of the plane's light

    /// An order of keys, member by member.
    // NOLINTNEXTLINE(modernize-use-nullptr): it compares with 0, which is no pointer
    auto operator<=>(const Key&) const = default;
  };
  /// An image that several may read.
  using SharedImage = std::shared_ptr<const Image<double>>;

  /// @param bytes  the most that the images may take together
  explicit ImageCache(std::size_t bytes) : capacity_(bytes) {}

  /// The image, or null where it is not held.
  SharedImage find(const Key& key);

  /// Holds an image, unless it alone is larger than the cache.
  void add(const Key& key, SharedImage image);

 private:
  using Entries = std::list<std::pair<Key, SharedImage>>;

  std::size_t capacity_;
  std::mutex lock_;
  std::size_t bytes_ = 0;
  Entries entries_;  ///< the last used one first
  std::map<Key, Entries::iterator> index_;
};

}  // namespace nlcwfs
