#pragma once
/// How the memory of this process behaves, for the programs that compute.

namespace clathra {

/// Asks the C library for huge pages, which it reads when a program starts: a step goes through all fields, and with pages of 4
/// KB the processor looks up an address for each few hundred discs. Nothing where GLIBC_TUNABLES is set already.
/// @return whether that changed the environment, so that the program has to be started anew
bool ask_for_huge_pages();

/// Replaces this process by the same program with the same arguments, which may use all cores that OpenMP found. Returns only
/// where the system does not let it.
void start_anew();

/// Searches and choices of the time step allocate and free the same fields over and over. Handed back to the system and fetched
/// anew, page by page, they made choosing a time step twice as dear.
void keep_freed_memory();

/// All of these: the first lines of a program that computes and has no settings of its own to see to.
void set_up_host_memory();

}  // namespace clathra
