//! Mode ATTRIBUTES: columns of bytes, each as differences from row to row, packed in groups of 16 (EXT_meshopt_compression,
//! appendix A; version 1 as KHR_meshopt_compression has it).

use super::{broken, take};

/// Rows of a group.
const GROUP: usize = 16;
/// Bytes of a block at most, and its rows.
const BLOCK_BYTES: usize = 8192;
const BLOCK_ROWS: usize = 256;

/// `count` rows of `stride` bytes.
pub(super) fn decode(data: &[u8], count: usize, stride: usize) -> Result<Vec<u8>, String> {
    let mut rest = data;
    let version = match take(&mut rest, 1)?[0] {
        0xa0 => 0,
        0xa1 => 1,
        head => return Err(format!("its packed data begin with {head:#04x}; 0xa0 and 0xa1 are read")),
    };
    // Behind the blocks: the row before the first one, and of version 1 how each four columns go together.
    let tail_size = if version == 0 { stride.max(32) } else { (stride + stride / 4).max(24) };
    let body_size = rest.len().checked_sub(tail_size).ok_or_else(broken)?;
    let (mut body, tail) = rest.split_at(body_size);
    let tail = &tail[tail.len() - if version == 0 { stride } else { stride + stride / 4 }..];
    let (before, channels) = tail.split_at(stride);
    let mut out = vec![0; count * stride];
    let rows = ((BLOCK_BYTES / stride) & !(GROUP - 1)).min(BLOCK_ROWS);
    let mut last = before.to_vec();
    for block in out.chunks_mut(rows * stride) {
        decode_block(&mut body, block, stride, &last, channels)?;
        last.copy_from_slice(&block[block.len() - stride..]);
    }
    if body.is_empty() { Ok(out) } else { Err(broken()) }
}

/// One block of rows; `channels` is empty in version 0.
fn decode_block(
    body: &mut &[u8],
    block: &mut [u8],
    stride: usize,
    last: &[u8],
    channels: &[u8],
) -> Result<(), String> {
    let rows = block.len() / stride;
    let aligned = rows.next_multiple_of(GROUP);
    let controls = take(body, channels.len())?;
    let mut columns = [const { [0; BLOCK_ROWS] }; 4];
    for quad in 0..stride / 4 {
        for (j, column) in columns.iter_mut().enumerate() {
            let control = controls.get(quad).map_or(0, |c| c >> (2 * j) & 3);
            match control {
                2 => column.fill(0),
                3 => column[..rows].copy_from_slice(take(body, rows)?),
                _ if channels.is_empty() => column_of(body, &mut column[..aligned], [0, 2, 4, 8])?,
                0 => column_of(body, &mut column[..aligned], [0, 1, 2, 4])?,
                _ => column_of(body, &mut column[..aligned], [1, 2, 4, 8])?,
            }
        }
        let before = &last[4 * quad..4 * quad + 4];
        let place = block[4 * quad..].chunks_mut(stride);
        let channel = channels.get(quad).copied().unwrap_or(0);
        add_up(&columns, place, before, channel)?;
    }
    Ok(())
}

/// One column: two bits a group say how many bits each of its bytes has.
fn column_of(body: &mut &[u8], column: &mut [u8], widths: [u32; 4]) -> Result<(), String> {
    let groups = column.len() / GROUP;
    let heads = take(body, groups.div_ceil(4))?;
    for (g, group) in column.chunks_exact_mut(GROUP).enumerate() {
        let width = widths[usize::from(heads[g / 4] >> (2 * (g % 4)) & 3)];
        match width {
            0 => group.fill(0),
            8 => group.copy_from_slice(take(body, GROUP)?),
            _ => narrow(body, group, width)?,
        }
    }
    Ok(())
}

/// 16 numbers of 1, 2 or 4 bits; the largest one says that a whole byte follows behind.
fn narrow(body: &mut &[u8], group: &mut [u8], width: u32) -> Result<(), String> {
    let packed = take(body, GROUP * width as usize / 8)?;
    let each = 8 / width as usize;
    let whole = (1u8 << width) - 1;
    for (i, value) in group.iter_mut().enumerate() {
        // From the upper end of each byte; single bits from the lower one.
        let at = if width == 1 { i % 8 } else { 8 - width as usize * (i % each + 1) };
        let bits = packed[i / each] >> at & whole;
        *value = if bits == whole { take(body, 1)?[0] } else { bits };
    }
    Ok(())
}

/// Differences → rows: of bytes, of pairs of bytes, or by exclusive or of four bytes turned round.
fn add_up<'a>(
    columns: &[[u8; BLOCK_ROWS]; 4],
    rows: impl Iterator<Item = &'a mut [u8]>,
    before: &[u8],
    channel: u8,
) -> Result<(), String> {
    let mut last = [before[0], before[1], before[2], before[3]];
    for (i, row) in rows.enumerate() {
        let step = [columns[0][i], columns[1][i], columns[2][i], columns[3][i]];
        last = match channel & 3 {
            0 => [0, 1, 2, 3].map(|j| last[j].wrapping_add(step[j] >> 1 ^ (step[j] & 1).wrapping_neg())),
            1 => {
                let pair = |j: usize| {
                    let (a, d) = (
                        u16::from_le_bytes([last[j], last[j + 1]]),
                        u16::from_le_bytes([step[j], step[j + 1]]),
                    );
                    a.wrapping_add(d >> 1 ^ (d & 1).wrapping_neg()).to_le_bytes()
                };
                let ([a, b], [c, d]) = (pair(0), pair(2));
                [a, b, c, d]
            }
            2 => {
                let turned = u32::from_le_bytes(step).rotate_right(u32::from(channel >> 4));
                (turned ^ u32::from_le_bytes(last)).to_le_bytes()
            }
            _ => return Err(broken()),
        };
        row[..4].copy_from_slice(&last);
    }
    Ok(())
}
