#pragma once

namespace lapwing::test {

/// While alive, counts calls of operator new in the whole program and has call number `fail_at`
/// (from 0; negative for none) throw std::bad_alloc.
class FailingNew {
 public:
  explicit FailingNew(long fail_at);
  FailingNew(const FailingNew&) = delete;
  FailingNew& operator=(const FailingNew&) = delete;
  ~FailingNew();

  static long calls();
};

/// Counts a call of an allocator other than operator new. Returns whether this call must fail.
bool allocation_fails();

}  // namespace lapwing::test
