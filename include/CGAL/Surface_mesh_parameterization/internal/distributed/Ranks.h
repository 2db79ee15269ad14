// Copyright (c) 2026  The HLSCM for CGAL authors.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_RANKS_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_RANKS_H

#include <CGAL/Blocked_execution/Progress.h>
#include <CGAL/Surface_mesh_parameterization/internal/stored/Streaming_failure.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <mpi.h>

namespace CGAL {
namespace Surface_mesh_parameterization {
namespace internal {

// Where the parts of the ranks begin in a distributed array, and its size.
typedef std::vector<std::size_t> Offsets;

// The ranks of a communicator, and what they do together: all of them call the same functions in
// the same order. Their messages are their own, and errors of MPI end all of them.
class Ranks
{
public:
  explicit Ranks(MPI_Comm comm)
  {
    MPI_Comm_dup(comm, &m_comm);
    MPI_Comm_set_errhandler(m_comm, MPI_ERRORS_ARE_FATAL);
    MPI_Comm_rank(m_comm, &m_rank);
    MPI_Comm_size(m_comm, &m_size);
  }
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  ~Ranks() { MPI_Comm_free(&m_comm); }

  MPI_Comm comm() const { return m_comm; }
  std::size_t rank() const { return std::size_t(m_rank); }
  std::size_t size() const { return std::size_t(m_size); }
  std::size_t bytes_sent() const { return m_bytes; } // to other ranks, by `exchange()`
  std::size_t messages_sent() const { return m_messages; }
  double seconds_alone() const { return m_seconds_alone; } // of work that was done `together()`

  double sum(double value) const { return reduced(value, MPI_DOUBLE, MPI_SUM); }
  std::size_t sum(std::size_t value) const
  {
    return std::size_t(reduced(std::uint64_t(value), MPI_UINT64_T, MPI_SUM));
  }
  double largest(double value) const { return reduced(value, MPI_DOUBLE, MPI_MAX); }
  double least(double value) const { return reduced(value, MPI_DOUBLE, MPI_MIN); }

  // What rank `from` has.
  template <class T>
  T broadcast(T value, std::size_t from = 0) const
  {
    static_assert(std::is_trivially_copyable<T>::value, "bytes are sent");
    MPI_Bcast(&value, int(sizeof(T)), MPI_BYTE, int(from), m_comm);
    return value;
  }
  std::string broadcast(std::string text, std::size_t from) const
  {
    text.resize(broadcast(text.size(), from));
    MPI_Bcast(text.data(), int(text.size()), MPI_CHAR, int(from), m_comm);
    return text;
  }

  // What all ranks have, by ranks.
  template <class T>
  std::vector<T> all(const T& value) const
  {
    static_assert(std::is_trivially_copyable<T>::value, "bytes are sent");
    std::vector<T> result(size());
    const int bytes = int(sizeof(T));
    MPI_Allgather(&value, bytes, MPI_BYTE, result.data(), bytes, MPI_BYTE, m_comm);
    return result;
  }

  Offsets offsets(std::size_t own) const
  {
    const std::vector<std::size_t> sizes = all(own);
    Offsets result(size() + 1, 0);
    std::partial_sum(sizes.begin(), sizes.end(), result.begin() + 1);
    return result;
  }

  // Sends the first counts[0] values to rank 0, the next counts[1] to rank 1 ...; returns what
  // comes from rank 0, from rank 1 ..., and in `counts` how much of it.
  template <class T>
  std::vector<T> exchange(const std::vector<T>& values, std::vector<std::size_t>& counts)
  {
    static_assert(std::is_trivially_copyable<T>::value, "bytes are sent");
    std::vector<int> sent(counts.begin(), counts.end()), received(size());
    // In brackets, since PETSc has macros of these names that count bytes, too.
    (MPI_Alltoall)(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, m_comm);
    const std::vector<int> from = places(sent), to = places(received);
    std::vector<T> result(std::size_t(to.back()) + std::size_t(received.back()));
    MPI_Datatype type;
    MPI_Type_contiguous(int(sizeof(T)), MPI_BYTE, &type);
    MPI_Type_commit(&type);
    (MPI_Alltoallv)(values.data(), sent.data(), from.data(), type, result.data(), received.data(),
                    to.data(), type, m_comm);
    MPI_Type_free(&type);
    for(std::size_t r = 0; r < size(); ++r)
      if(r != rank() && sent[r] > 0) {
        m_bytes += std::size_t(sent[r]) * sizeof(T);
        ++m_messages;
      }
    counts.assign(received.begin(), received.end());
    return result;
  }

  // All values on rank 0, by ranks.
  template <class T>
  std::vector<T> gathered(const std::vector<T>& values)
  {
    std::vector<std::size_t> counts(size(), 0);
    counts[0] = values.size();
    return exchange(values, counts);
  }

  // Entries of a distributed array, whose part of this rank is `local(i)`, 0 <= i < its size.
  // `wanted`: ascending.
  template <class T, class Local>
  std::vector<T> values_at(const std::vector<std::uint32_t>& wanted, const Offsets& begin,
                           const Local& local)
  {
    std::vector<std::size_t> counts(size());
    for(std::size_t r = 0; r < size(); ++r)
      counts[r] = std::size_t(std::lower_bound(wanted.begin(), wanted.end(), begin[r + 1])
                              - std::lower_bound(wanted.begin(), wanted.end(), begin[r]));
    const std::vector<std::uint32_t> asked = exchange(wanted, counts);
    std::vector<T> answers(asked.size());
    for(std::size_t i = 0; i < asked.size(); ++i)
      answers[i] = local(asked[i] - begin[rank()]);
    return exchange(answers, counts);
  }

  // What `decide()` returns on rank 0. What it throws is thrown there when the others know: they
  // get `false`.
  template <class Decide>
  bool decided_by_first(const Decide& decide) const
  {
    bool result = false;
    std::exception_ptr error;
    if(rank() == 0) {
      try {
        result = decide();
      } catch(...) {
        error = std::current_exception();
      }
    }
    result = broadcast(result);
    if(error != nullptr)
      std::rethrow_exception(error);
    return result;
  }

  // Does what each rank does alone. What one of them refuses ends the work of all, with its
  // sentence.
  template <class Work>
  void together(const Work& work) const
  {
    constexpr int nothing = -1;
    int kind = nothing, error = OK;
    std::string sentence;
    const Blocked_execution::Stopwatch watch;
    try {
      work();
    } catch(const Streaming_failure& failure) {
      kind = failure.kind;
      error = failure.error;
      sentence = failure.what();
    } catch(const std::bad_alloc&) {
      kind = Streaming_failure::RESUMABLE;
      error = ERROR_CANNOT_SOLVE_LINEAR_SYSTEM;
      sentence = "rank " + std::to_string(rank()) + " has not enough memory, let more ranks work";
    } catch(const std::exception& failure) {
      kind = Streaming_failure::RESUMABLE;
      error = ERROR_CANNOT_SOLVE_LINEAR_SYSTEM;
      sentence = "rank " + std::to_string(rank()) + " cannot go on: " + failure.what();
    }
    m_seconds_alone += watch.seconds();
    const std::vector<int> kinds = all(kind);
    const auto failed
      = std::find_if(kinds.begin(), kinds.end(), [](int k) { return k != nothing; });
    if(failed == kinds.end())
      return;
    const std::size_t first = std::size_t(failed - kinds.begin());
    throw Streaming_failure(Streaming_failure::Kind(*failed), broadcast(sentence, first),
                            Error_code(broadcast(error, first)));
  }

private:
  template <class T>
  T reduced(T value, MPI_Datatype type, MPI_Op operation) const
  {
    T result;
    MPI_Allreduce(&value, &result, 1, type, operation, m_comm);
    return result;
  }

  static std::vector<int> places(const std::vector<int>& counts)
  {
    std::vector<int> result(counts.size(), 0);
    std::partial_sum(counts.begin(), counts.end() - 1, result.begin() + 1);
    return result;
  }

  MPI_Comm m_comm = MPI_COMM_NULL;
  int m_rank = 0, m_size = 1;
  std::size_t m_bytes = 0, m_messages = 0;
  mutable double m_seconds_alone = 0.;
};

// Entries of a distributed array on one rank: its own, which are `local`, and others that it asks
// for, ascending.
template <class T>
class Known_entries
{
public:
  Known_entries(Ranks& ranks, const Offsets& begin, const std::vector<T>& local,
                std::vector<std::uint32_t> others)
    : m_first(begin[ranks.rank()]), m_local(local), m_others(std::move(others))
    , m_values(ranks.values_at<T>(m_others, begin, [&local](std::size_t i) { return local[i]; }))
  {}

  const T& operator[](std::uint32_t i) const
  {
    if(i - m_first < m_local.size())
      return m_local[i - m_first];
    return m_values[std::size_t(std::lower_bound(m_others.begin(), m_others.end(), i)
                                - m_others.begin())];
  }

private:
  std::size_t m_first;
  const std::vector<T>& m_local;
  std::vector<std::uint32_t> m_others;
  std::vector<T> m_values;
};

} // namespace internal
} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_INTERNAL_DISTRIBUTED_RANKS_H
