// Objects that a thread keeps until its end, without the destructors of `thread_local` objects.
#pragma once

#include <pthread.h>

#include <forward_list>
#include <memory>
#include <system_error>
#include <utility>

namespace supernormal {

/// What the threads keep on the heap: a key of POSIX threads has a list for each thread. At the end of a thread its objects are
/// destroyed, the latest first. The main thread keeps its objects to the end of the process.
class KeptByThreads {
 public:
  static KeptByThreads& of_library() {
    static KeptByThreads threads;
    return threads;
  }
  ~KeptByThreads() { pthread_key_delete(key_); }  // a thread may outlive the code of the library
  KeptByThreads(const KeptByThreads&) = delete;
  KeptByThreads(KeptByThreads&&) = delete;
  KeptByThreads& operator=(const KeptByThreads&) = delete;
  KeptByThreads& operator=(KeptByThreads&&) = delete;

  /// A new object of this thread.
  template <typename Object>
  Object& make() {
    auto object = std::make_shared<Object>();
    Object& kept = *object;
    auto* list = static_cast<List*>(pthread_getspecific(key_));
    if (list == nullptr) {
      list = new List;
      pthread_setspecific(key_, list);  // if it fails, the objects are never destroyed
    }
    list->push_front(std::move(object));
    return kept;
  }

 private:
  using List = std::forward_list<std::shared_ptr<void>>;

  KeptByThreads() {
    const int error = pthread_key_create(&key_, [](void* list) { delete static_cast<List*>(list); });
    if (error != 0) throw std::system_error(error, std::generic_category(), "Supernormal: pthread_key_create");
  }

  pthread_key_t key_{};
};

/// An object of each thread, made at its first use. Declare it `thread_local`; it has no destructor of its own.
template <typename Object>
class KeptByKey {
 public:
  Object& operator*() {
    if (object_ == nullptr) object_ = &KeptByThreads::of_library().make<Object>();
    return *object_;
  }

 private:
  Object* object_ = nullptr;
};

}  // namespace supernormal
