// Fourier transforms of lines and squares, through FFTW.
#include "model/fourier_transform.hpp"

#include <mutex>

#include <fftw3.h>

namespace nlcwfs {
namespace {

/// The FFTW planner is not thread-safe.
std::mutex& planner_lock() {
  static std::mutex lock;
  return lock;
}

template <class Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  using Complex = fftw_complex;
  static constexpr auto plan = fftw_plan_dft_1d;
  static constexpr auto execute = fftw_execute_dft;
  static constexpr auto destroy = fftw_destroy_plan;
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  using Complex = fftwf_complex;
  static constexpr auto plan = fftwf_plan_dft_1d;
  static constexpr auto execute = fftwf_execute_dft;
  static constexpr auto destroy = fftwf_destroy_plan;
};

}  // namespace

template <class Real>
struct LineTransform<Real>::Plans {
  using Library = Fftw<Real>;
  using Complex = typename Library::Complex;

  explicit Plans(int length) {
    Eigen::ArrayX<std::complex<Real>> in(length);
    Eigen::ArrayX<std::complex<Real>> out(length);
    const auto plan = [&](int sign) {
      return Library::plan(length, reinterpret_cast<Complex*>(in.data()),
                           reinterpret_cast<Complex*>(out.data()), sign,
                           FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
    };
    const std::scoped_lock lock(planner_lock());
    forward = plan(FFTW_FORWARD);
    backward = plan(FFTW_BACKWARD);
  }
  ~Plans() {
    const std::scoped_lock lock(planner_lock());
    Library::destroy(forward);
    Library::destroy(backward);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;

  /// FFTW's interface takes the input as mutable, but preserves it.
  void execute(typename Library::Plan plan, const std::complex<Real>* in,
               std::complex<Real>* out) const {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
    Library::execute(plan, reinterpret_cast<Complex*>(const_cast<std::complex<Real>*>(in)),
                     reinterpret_cast<Complex*>(out));
  }

  typename Library::Plan forward;
  typename Library::Plan backward;
};

template <class Real>
LineTransform<Real>::LineTransform(int length) : length_(length) {
  assert(length >= 1);
  plans_ = std::make_shared<const Plans>(length);
}

template <class Real>
void LineTransform<Real>::forward(const std::complex<Real>* in, std::complex<Real>* out) const {
  plans_->execute(plans_->forward, in, out);
}

template <class Real>
void LineTransform<Real>::backward(const std::complex<Real>* in, std::complex<Real>* out) const {
  plans_->execute(plans_->backward, in, out);
}

template class LineTransform<float>;
template class LineTransform<double>;

int fast_transform_length(int minimum) {
  for (int length = minimum + minimum % 2;; length += 2) {
    int rest = length;
    for (const int factor : {2, 3, 5, 7}) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) return length;
  }
}

}  // namespace nlcwfs
