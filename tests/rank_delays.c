// Loaded before MPI by the tests of ranks: now and then a message is late (RINGLET_DELAY_SEED).
#define _DEFAULT_SOURCE
#include <mpi.h>
#include <stdlib.h>
#include <unistd.h>

static void delay(void) {
  static unsigned state;
  if (state == 0) {
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const char* seed = getenv("RINGLET_DELAY_SEED");
    state = 1 + 7919 * (unsigned)(seed ? atoi(seed) : 1) + 104729 * (unsigned)rank;
  }
  state = state * 1664525 + 1013904223;
  if (state >> 29 == 0) usleep(state >> 16 & 0x3fff);  // one in eight, up to 16 ms
}

int MPI_Isend(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  delay();
  return PMPI_Isend(bytes, count, type, to, tag, comm, request);
}
int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  delay();
  return PMPI_Waitall(count, requests, statuses);
}
int MPI_Allreduce(const void* send, void* receive, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  delay();
  return PMPI_Allreduce(send, receive, count, type, op, comm);
}
int MPI_Send(const void* bytes, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  delay();
  return PMPI_Send(bytes, count, type, to, tag, comm);
}
int MPI_Recv(void* bytes, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status) {
  delay();
  return PMPI_Recv(bytes, count, type, from, tag, comm, status);
}
