// Noise-free images are kept for the next design that reads the same plane.
#include "model/image_cache.hpp"

namespace nlcwfs {
namespace {

std::size_t bytes_of(const Image<double>& image) {
  return static_cast<std::size_t>(image.size()) * sizeof(double);
}

}  // namespace

ImageCache::SharedImage ImageCache::find(const Key& key) {
  const std::scoped_lock lock(lock_);
  const auto found = index_.find(key);
  if (found == index_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->second;
}

void ImageCache::add(const Key& key, SharedImage image) {
  const std::size_t bytes = bytes_of(*image);
  if (bytes > capacity_) return;
  const std::scoped_lock lock(lock_);
  if (index_.contains(key)) return;
  while (bytes_ + bytes > capacity_) {
    bytes_ -= bytes_of(*entries_.back().second);
    index_.erase(entries_.back().first);
    entries_.pop_back();
  }
  entries_.emplace_front(key, std::move(image));
  index_.emplace(key, entries_.begin());
  bytes_ += bytes;
}

}  // namespace nlcwfs
