/* The frontier of a search with fingerprints: a first-in-first-out queue of whole states.
 *
 * States are taken from `head` and put behind `tail`. When the tail, or the local states that it
 * needs, take too much memory, it goes to the disk as a chunk (as the queue of TLC does): packed
 * states, and the contents of the local states that they are made of, each once. Chunks are written
 * to the file `out` and read from `in`; when that is used up the two change places.
 */
#ifndef REBSYNC_FRONTIER_H
#define REBSYNC_FRONTIER_H

#include "visited.h"

/* What may be kept in memory besides fingerprints: little beside them, but not too little. */
static size_t size_allowed(const struct search *s)
{
    size_t share = size_of_prints(&s->prints) / BESIDE;
    return share > LEAST ? share : LEAST;
}

static uint64_t *packed_in(const struct search *s, const struct states *of, uint64_t at)
{
    return (uint64_t *)of->packed.data + at * s->words;
}

static void push_state(struct search *s, const uint64_t *words, int64_t time)
{
    struct states *tail = &s->frontier.tail;
    room_for(s->escape, &tail->packed, (tail->count + 1) * s->words * sizeof *words, 1);
    memcpy(packed_in(s, tail, tail->count), words, s->words * sizeof *words);
    if (s->until != NEVER) {
        tail->times.count = tail->count;
        *(int64_t *)added(s->escape, &tail->times, sizeof time) = time;
    }
    tail->count++;
}

/* --- local states */

/* Calls for the states of one end of the queue that are still to be expanded. */
static void each_waiting(struct search *s, struct states *of,
                         void (*call)(struct search *s, uint64_t *words))
{
    for (uint64_t at = of->expanded; at < of->count; at++) {
        unpack(s, packed_in(s, of, at), s->unpacked);
        call(s, packed_in(s, of, at));
    }
}

static void mark_locals(struct search *s, uint64_t *words)
{
    (void)words;
    uint32_t *numbers = (uint32_t *)s->frontier.numbers.data;
    for (uint32_t r = 0; r < s->rebecs; r++)
        numbers[s->frontier.first[r] + s->unpacked[r]] = 1;
}

static void renumber(struct search *s, uint64_t *words)
{
    const uint32_t *numbers = (uint32_t *)s->frontier.numbers.data;
    for (uint32_t r = 0; r < s->rebecs; r++)
        s->unpacked[r] = numbers[s->frontier.first[r] + s->unpacked[r]];
    pack(s, s->unpacked, words);
}

/* Room for a number for each local state, those of the first rebec first; all are 0. */
static uint32_t *number_locals(struct search *s, const uint32_t *locals)
{
    size_t total = 0;
    for (uint32_t r = 0; r < s->rebecs; r++) {
        s->frontier.first[r] = total;
        total += locals ? locals[r] : kernel_locals(s->kernel, r);
    }
    size_t size = total * sizeof(uint32_t);
    return memset(room_for(s->escape, &s->frontier.numbers, size + 1, 1), 0, size);
}

/* Leaves only local states of states that wait; the others are made again when they are met. */
static void collect(struct search *s)
{
    uint32_t *numbers = number_locals(s, NULL);
    each_waiting(s, &s->frontier.head, mark_locals);
    each_waiting(s, &s->frontier.tail, mark_locals);
    kernel_collect(s->kernel, numbers);
    each_waiting(s, &s->frontier.head, renumber);
    each_waiting(s, &s->frontier.tail, renumber);
}

/* --- chunks */

struct chunk {
    uint64_t states, words, timed;
};

static void write_all(struct search *s, const void *data, size_t size, size_t count)
{
    if (fwrite(data, size, count, s->frontier.out.file) != count)
        give_up(s->escape);
}

static void read_all(struct search *s, void *data, size_t size, size_t count)
{
    if (fread(data, size, count, s->frontier.in.file) != count)
        give_up(s->escape);
}

/* Writes the marked local states of a rebec: number, length and content of each. */
static void write_locals(struct search *s, uint32_t rebec, const uint32_t *marks)
{
    uint32_t locals = kernel_locals(s->kernel, rebec), marked = 0;
    for (uint32_t number = 0; number < locals; number++)
        marked += marks[number];
    write_all(s, &marked, sizeof marked, 1);
    for (uint32_t number = 0; number < locals; number++) {
        if (!marks[number])
            continue;
        const unsigned char *content;
        size_t length = kernel_content(s->kernel, rebec, number, &content);
        write_all(s, &number, sizeof number, 1);
        write_all(s, &length, sizeof length, 1);
        write_all(s, content, 1, length);
    }
}

/* Writes the tail to the disk. */
static void spill(struct search *s)
{
    struct states *tail = &s->frontier.tail;
    struct chunk chunk = {tail->count, s->words, s->until != NEVER};
    if (!tail->count)
        return;
    uint32_t *marks = number_locals(s, NULL);
    each_waiting(s, tail, mark_locals);
    write_all(s, &chunk, sizeof chunk, 1);
    write_all(s, s->fields, sizeof *s->fields, s->rebecs);
    for (uint32_t r = 0; r < s->rebecs; r++)
        s->ids[r] = kernel_locals(s->kernel, r);
    write_all(s, s->ids, sizeof *s->ids, s->rebecs);
    for (uint32_t r = 0; r < s->rebecs; r++)
        write_locals(s, r, marks + s->frontier.first[r]);
    write_all(s, tail->packed.data, s->words * sizeof(uint64_t), tail->count);
    if (chunk.timed)
        write_all(s, tail->times.data, sizeof(int64_t), tail->count);
    if (fflush(s->frontier.out.file))
        give_up(s->escape);
    s->frontier.out.chunks++;
    tail->count = 0;
}

/* Reads local states of a rebec: for the number that each had, the one that it has now. */
static void read_locals(struct search *s, uint32_t rebec, uint32_t *numbers)
{
    uint32_t count, number;
    size_t length;
    for (read_all(s, &count, sizeof count, 1); count; count--) {
        read_all(s, &number, sizeof number, 1);
        read_all(s, &length, sizeof length, 1);
        unsigned char *content = room_for(s->escape, &s->frontier.content, length, 1);
        read_all(s, content, 1, length);
        numbers[number] = kernel_number(s->kernel, rebec, content);
        if (numbers[number] == NONE)
            give_up(s->escape);
    }
}

/* Reads packed states into the head, one by one, as numbers and fields are now. */
static void read_packed(struct search *s, struct chunk chunk, struct field *fields)
{
    struct states *head = &s->frontier.head;
    struct field *now = s->fields;
    uint64_t *words = room_for(s->escape, &s->frontier.content, chunk.words * sizeof *words, 1);
    room_for(s->escape, &head->packed, chunk.states * s->words * sizeof *words, 1);
    for (; head->count < chunk.states; head->count++) {
        read_all(s, words, sizeof *words, chunk.words);
        s->fields = fields;
        unpack(s, words, s->unpacked);
        s->fields = now;
        renumber(s, packed_in(s, head, head->count));
    }
}

static void read_chunk(struct search *s)
{
    struct frontier *f = &s->frontier;
    struct chunk chunk;
    read_all(s, &chunk, sizeof chunk, 1);
    read_all(s, f->fields, sizeof *f->fields, s->rebecs);
    read_all(s, s->ids, sizeof *s->ids, s->rebecs);
    uint32_t *numbers = number_locals(s, s->ids);
    for (uint32_t r = 0; r < s->rebecs; r++)
        read_locals(s, r, numbers + f->first[r]);
    if (s->wide)
        repack(s);
    read_packed(s, chunk, f->fields);
    if (chunk.timed)
        read_all(s, room_for(s->escape, &f->head.times, chunk.states, sizeof(int64_t)),
                 sizeof(int64_t), chunk.states);
    f->in.chunks--;
}

/* --- both ends */

/* Fills the head, which has been expanded, with the states that have waited longest. There are some,
 * and nothing is pending. */
static void refill(struct search *s)
{
    struct frontier *f = &s->frontier;
    f->head.count = f->head.expanded = 0;
    if (!f->in.chunks && f->out.chunks) {
        struct chunks read = f->in;
        f->in = f->out;
        f->out = read;
        rewind(f->in.file);
        rewind(f->out.file);
    }
    if (f->in.chunks) {
        read_chunk(s);
        return;
    }
    struct states empty = f->head;
    f->head = f->tail;
    f->tail = empty;
}

/* Gives up, now and then, what the states that wait do not need, or lets them wait on the disk.
 * Nothing is pending. */
static void tidy(struct search *s)
{
    struct frontier *f = &s->frontier;
    size_t allowed = size_allowed(s);
    if (f->tail.count * s->words * sizeof(uint64_t) > allowed)
        spill(s);
    if (kernel_size(s->kernel) <= f->collect_at)
        return;
    collect(s);
    if (f->tail.count && kernel_size(s->kernel) > allowed / 2) {
        spill(s);
        collect(s);
    }
    size_t half_more = kernel_size(s->kernel) + kernel_size(s->kernel) / 2;
    f->collect_at = half_more > allowed ? half_more : allowed;
}

static void free_frontier(struct frontier *f)
{
    void *parts[] = {f->head.packed.data, f->head.times.data, f->tail.packed.data, f->tail.times.data,
                     f->first, f->fields, f->numbers.data, f->content.data};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        free(parts[i]);
    if (f->in.file)
        fclose(f->in.file);
    if (f->out.file)
        fclose(f->out.file);
}

/* 0 without memory, or a place for its files. */
static int make_frontier(struct frontier *f, uint32_t rebecs)
{
    f->collect_at = LEAST;
    f->first = calloc(rebecs, sizeof *f->first);
    f->fields = calloc(rebecs, sizeof *f->fields);
    f->in.file = tmpfile();
    f->out.file = tmpfile();
    return f->first && f->fields && f->in.file && f->out.file;
}

#endif
